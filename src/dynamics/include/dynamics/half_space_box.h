#pragma once

#include "dynamics/body_store.h"

#include <cmath>

namespace carom::internal {

/// Does a box reach into the half-space of this (static) shape?
[[nodiscard]] inline bool reaches_half_space(const SceneState& state, int half_space, const FloatBox& box, float margin)
{
    const ShapeRecord& record = state.shapes[half_space];
    const Pose pose = state.sims[static_cast<std::size_t>(record.body)].pose();
    const Vec2 n = rotate(pose.rotation, record.leaf.p0);
    const double low =
        n.x * ((n.x > 0 ? box.lx : box.ux) - pose.position.x) + n.y * ((n.y > 0 ? box.ly : box.uy) - pose.position.y);
    return low <= static_cast<double>(record.leaf.r0) + static_cast<double>(margin);
}

/// Do the fat boxes of two shapes overlap?
[[nodiscard]] inline bool boxes_meet(const SceneState& state, int a, int b)
{
    if (state.shapes[a].leaf.type == LeafType::HalfSpace)
        return reaches_half_space(state, a, state.broad_phase.box(b), 0);
    if (state.shapes[b].leaf.type == LeafType::HalfSpace)
        return reaches_half_space(state, b, state.broad_phase.box(a), 0);
    return overlaps(state.broad_phase.box(a), state.broad_phase.box(b));
}

} // namespace carom::internal
