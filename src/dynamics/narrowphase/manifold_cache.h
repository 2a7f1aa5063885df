#pragma once

// In crowds most pairs move together: boxes that lie on each other, a pile that a drum turns as a whole. What the narrow phase found of such a
// pair is kept, fixed to the two bodies, and followed instead of found again, until one has moved against the other (the idea is Box2D 3.2's
// contact recycling; there anchors and normal stay as they were in the world, here they turn with their bodies, so that separations are exact).
// Few bodies alone are always looked at anew: there a contact decides where a ball goes.

#include "dynamics/solver/simd/kernels.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Both bodies were solved in a crowd in the last step, or do not count.
[[nodiscard]] inline bool in_crowd(const SceneState& state, const Contact& contact)
{
    return state.sims[static_cast<std::size_t>(contact.body_a)].crowded &&
           state.sims[static_cast<std::size_t>(contact.body_b)].crowded;
}

/// It was found in a crowd, and nothing has been done to it since.
[[nodiscard]] inline bool is_cached(const Contact& contact)
{
    return (contact.flags & (contact_flag::kept | contact_flag::fresh)) == contact_flag::kept;
}

/// Or, without a point, whether the direction that parts them is in the axes of b.
[[nodiscard]] inline bool caches_edge_of_b(const Contact& contact) { return (contact.flags & contact_flag::edge_of_b) != 0; }
[[nodiscard]] inline bool caches_nearest(const Contact& contact) { return (contact.flags & contact_flag::nearest) != 0; }

/// The manifold of a contact in a crowd at the start of the step: followed, or found again. Impulses are carried over.
void follow_manifold(const StepContext& ctx, int index);

/// The kernel's way is rounded otherwise than that of follow_manifold, which decides where it is close.
inline constexpr float surely = 0.999f;
[[nodiscard]] FollowedScene followed_scene(const StepContext& ctx);

/// What has become of it can be told with others: in a crowd, nothing has been done to it, and without a point it did not touch.
[[nodiscard]] inline bool is_updated_with_others(const SceneState& state, const Contact& contact)
{
    const std::uint32_t asked = contact_flag::kept | contact_flag::fresh | contact_flag::one_way | contact_flag::passing |
                                (contact.manifold.count == 0 ? contact_flag::touching : 0);
    return (contact.flags & asked) == contact_flag::kept && in_crowd(state, contact);
}

/// Between steps, a contact's manifold at the poses of the start of the last: where its row has followed it, it is followed here now.
[[nodiscard]] Manifold settled_manifold(const SceneState& state, int contact);

/// Writes it into the contact: before poses are lost.
void settle_manifold(SceneState& state, int contact);

} // namespace carom::internal
