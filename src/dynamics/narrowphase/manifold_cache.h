#pragma once

// In crowds most pairs move together: boxes that lie on each other, a pile that a drum turns as a whole. The manifold of such a pair is cached, fixed to the
// two bodies, and followed instead of found again until one has moved against the other. The idea is the contact recycling of Box2D 3.2. There anchors and
// normal stay as they were in the world; here they turn with their bodies, so that separations are exact. Contacts of few bodies are always found anew: there a
// contact decides a ball's path.

#include "dynamics/solver/simd/kernels.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// True if each body was solved in a crowd in the last step, or is not dynamic.
[[nodiscard]] inline bool caches_manifold(const SceneState& state, const Contact& contact)
{
    return state.sims[static_cast<std::size_t>(contact.body_a)].caches_manifolds &&
           state.sims[static_cast<std::size_t>(contact.body_b)].caches_manifolds;
}

/// True if the manifold was found in a crowd and nothing has changed the contact since.
[[nodiscard]] inline bool is_cached(const Contact& contact)
{
    return (contact.flags & (contact_flag::cached | contact_flag::fresh)) == contact_flag::cached;
}

/// True if the cached edge belongs to b or, without a point, if the separating direction is in the axes of b.
[[nodiscard]] inline bool caches_edge_of_b(const Contact& contact) { return (contact.flags & contact_flag::edge_of_b) != 0; }
[[nodiscard]] inline bool caches_nearest(const Contact& contact) { return (contact.flags & contact_flag::nearest) != 0; }

/// Updates the manifold of a contact in a crowd to the start of the step: followed, or found again. Impulses are carried over.
void follow_manifold(const StepContext& ctx, int index);

/// The kernel rounds differently from follow_manifold, which decides close cases.
inline constexpr float surely = 0.999f;
[[nodiscard]] FollowedScene followed_scene(const StepContext& ctx);

/// True if the contact can be updated in a batch: it is in a crowd, nothing has changed it, and without a point it did not touch.
[[nodiscard]] inline bool is_updated_with_others(const SceneState& state, const Contact& contact)
{
    const std::uint32_t asked = contact_flag::cached | contact_flag::fresh | contact_flag::one_way | contact_flag::passing |
                                (contact.manifold.count == 0 ? contact_flag::touching : 0);
    return (contact.flags & asked) == contact_flag::cached && caches_manifold(state, contact);
}

/// Manifold of a contact between steps, at the poses of the start of the last step. Where only its wide constraint has followed it, it is followed here.
[[nodiscard]] Manifold settled_manifold(const SceneState& state, int contact);

/// Writes the settled manifold into the contact, before poses are lost.
void settle_manifold(SceneState& state, int contact);

} // namespace carom::internal
