#pragma once

// The world manifold of a contact, and the transfer of impulses to its new points.

#include "collision/manifold.h"
#include "dynamics/state/body_store.h"

#include <array>

namespace carom::internal {

/// Pose of a body within the step.
struct BodyPose
{
    Position center{};
    Rotation rotation{};
    Vec2 local_center{};

    [[nodiscard]] Pose frame() const { return {center - rotate(rotation, local_center), rotation}; }
};

/// The manifold that the narrow phase finds, in a's frame.
[[nodiscard]] LocalManifold local_manifold(const SceneState& state, const Contact& contact, const BodyPose& a, const BodyPose& b,
                                           float margin);

/// The same with anchors relative to the centers of mass, in world axes.
[[nodiscard]] Manifold in_world(const LocalManifold& local, const BodyPose& a, const BodyPose& b);
[[nodiscard]] Manifold world_manifold(const SceneState& state, const Contact& contact, const BodyPose& a, const BodyPose& b,
                                      float margin);

/// For each point of a fresh manifold its index in the old one, or none. A point is the same as the old one with the same feature, or, once the reference
/// edge is the other shape's, as the nearest one; a single point always is the same as a single old one.
[[nodiscard]] std::array<int, 2> match_points(const Manifold& old, const Manifold& fresh);

/// Warm starting: points take over the impulses of those that they match.
void carry_impulses(const Manifold& old, Manifold& fresh, ContactImpulses& impulses);

[[nodiscard]] inline BodyPose pose_at_start(const SceneState& state, int body)
{
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    return {sim.center, sim.rotation, sim.local_center};
}

/// Bound on how much closer the two shapes may come in this step if nothing strikes them.
[[nodiscard]] inline float relative_motion(const SceneState& state, const Contact& contact)
{
    const BoxPath& a = state.broad_phase.path(contact.shape_a);
    const BoxPath& b = state.broad_phase.path(contact.shape_b);
    return length(b.shift - a.shift) + a.any_displacement + b.any_displacement;
}

/// Updates the manifold to the start of the step, and returns the contact change. Writes to this contact alone.
[[nodiscard]] TouchChange update_contact(const StepContext& ctx, int index);

/// True if the contact wakes no body and no other contact belongs to the same two shapes: any thread may report its changes.
[[nodiscard]] inline bool concerns_no_other(const Contact& contact)
{
    return (contact.flags & (contact_flag::piece | contact_flag::sleeper)) == 0;
}

[[nodiscard]] inline float least_separation(const Manifold& m)
{
    // No loop: its number of iterations would be mispredicted.
    const float first = m.count > 0 ? m.points[0].separation : 3e38f;
    const float second = m.count > 1 ? m.points[1].separation : 3e38f;
    return second < first ? second : first;
}

/// True if a manifold without points means that the shapes are apart.
[[nodiscard]] inline bool means_apart(const Contact& contact)
{
    return (contact.flags & (contact_flag::plain | contact_flag::of_union)) == contact_flag::plain;
}

/// True if the shapes do not meet within the step on their initial paths.
[[nodiscard]] inline bool stays_apart(const StepContext& ctx, const Contact& contact)
{
    return means_apart(contact) &&
           (contact.manifold.count == 0 ||
            least_separation(contact.manifold) > relative_motion(ctx.state, contact) + 0.1f * ctx.scene.tolerances.speculation);
}

/// True if the contact has points and does not let its shapes pass.
[[nodiscard]] inline bool is_solved(const Contact& contact)
{
    return contact.manifold.count > 0 && (contact.flags & contact_flag::passing) == 0;
}

/// Does the contact bear a load, or overlap so that it must be pushed apart? Then its bodies do not fly. An overlap that ends by itself within the step need
/// not be pushed apart. `separation`: the least of its points.
[[nodiscard]] inline bool is_loaded(const StepContext& ctx, const Contact& contact, float separation)
{
    const bool loaded = separation <= ctx.scene.tolerances.speculation && (contact.flags & contact_flag::loaded) != 0;
    return loaded || (separation < -ctx.scene.tolerances.slop &&
                      motion_of(ctx, contact.body_a) + motion_of(ctx, contact.body_b) < -4 * separation);
}

} // namespace carom::internal
