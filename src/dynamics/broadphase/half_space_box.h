#pragma once

// Overlap of fat boxes, of which one may belong to a half-space.

#include "dynamics/state/body_store.h"

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
    const BroadPhase& boxes = state.broad_phase;
    if (boxes.traits(a).unbounded)
        return reaches_half_space(state, a, boxes.box(b), 0);
    if (boxes.traits(b).unbounded)
        return reaches_half_space(state, b, boxes.box(a), 0);
    return overlaps(boxes.box(a), boxes.box(b));
}

} // namespace carom::internal
