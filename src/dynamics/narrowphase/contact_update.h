#pragma once

// The world manifold of a contact, and how old impulses find their new points.

#include "collision/manifold.h"
#include "dynamics/state/body_store.h"

namespace carom::internal {

/// Where a body stands within the step.
struct BodyPose
{
    Position center{};
    Rotation rotation{};
    Vec2 local_center{};

    [[nodiscard]] Pose frame() const { return {center - rotate(rotation, local_center), rotation}; }
};

/// What the narrow phase finds, in a's frame.
[[nodiscard]] LocalManifold local_manifold(const SceneState& state, const Contact& contact, const BodyPose& a, const BodyPose& b,
                                           float margin);

/// The same with anchors from the centers of mass, in world axes.
[[nodiscard]] Manifold in_world(const LocalManifold& local, const BodyPose& a, const BodyPose& b);
[[nodiscard]] Manifold world_manifold(const SceneState& state, const Contact& contact, const BodyPose& a, const BodyPose& b,
                                      float margin);

/// Points with the feature of an old one take over its impulses; a single point in a single point's place does too.
void carry_impulses(const Manifold& old, Manifold& fresh, ContactImpulses& impulses);

[[nodiscard]] inline BodyPose pose_at_start(const SceneState& state, int body)
{
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    return {sim.center, sim.rotation, sim.local_center};
}

/// How much nearer the two may come in this step, if nothing strikes them.
[[nodiscard]] inline float relative_motion(const SceneState& state, const Contact& contact)
{
    const BoxPath& a = state.broad_phase.path(contact.shape_a);
    const BoxPath& b = state.broad_phase.path(contact.shape_b);
    return length(b.shift - a.shift) + a.any_path + b.any_path;
}

/// Its manifold at the start of the step, and what others must hear of. Writes to this contact alone.
[[nodiscard]] TouchChange update_contact(const StepContext& ctx, int index);

/// It wakes nobody, and no other contact speaks for the same two shapes: what becomes of it may be told by any thread.
[[nodiscard]] inline bool concerns_no_other(const Contact& contact)
{
    return (contact.flags & (contact_flag::piece | contact_flag::sleeper)) == 0;
}

[[nodiscard]] inline float least_separation(const Manifold& m)
{
    // No loop: how often it goes round would be guessed wrong.
    const float first = m.count > 0 ? m.points[0].separation : 3e38f;
    const float second = m.count > 1 ? m.points[1].separation : 3e38f;
    return second < first ? second : first;
}

/// Without points its shapes are apart.
[[nodiscard]] inline bool means_apart(const Contact& contact)
{
    return (contact.flags & (contact_flag::plain | contact_flag::of_union)) == contact_flag::plain;
}

/// On the ways that both set out on they do not meet within the step.
[[nodiscard]] inline bool stays_apart(const StepContext& ctx, const Contact& contact)
{
    return means_apart(contact) &&
           (contact.manifold.count == 0 ||
            least_separation(contact.manifold) > relative_motion(ctx.state, contact) + 0.1f * ctx.scene.tolerances.speculation);
}

/// It has points that are not let through.
[[nodiscard]] inline bool is_solved(const Contact& contact)
{
    return contact.manifold.count > 0 && (contact.flags & contact_flag::passing) == 0;
}

/// Is it borne, or does it overlap something that must be pushed out? Then it does not fly. What will be apart by itself within the step need not
/// be pushed. `separation`: the least of its points.
[[nodiscard]] inline bool is_loaded(const StepContext& ctx, const Contact& contact, float separation)
{
    const bool loaded = separation <= ctx.scene.tolerances.speculation && (contact.flags & contact_flag::loaded) != 0;
    return loaded || (separation < -ctx.scene.tolerances.slop &&
                      motion_of(ctx, contact.body_a) + motion_of(ctx, contact.body_b) < -4 * separation);
}

} // namespace carom::internal
