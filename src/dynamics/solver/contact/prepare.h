#pragma once

// From records to what the solver iterates over.

#include "core/trigonometry.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Number by number, where they stand: a record that has just been written so is waited for by a copy.
inline void start_state(const SceneState& state, int body, BodyState& s)
{
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    s.velocity = sim.velocity;
    s.angular_velocity = sim.angular_velocity;
    s.flags = state.bodies[body].type == BodyType::Dynamic ? body_flag::dynamic | body_flag::unbound : 0;
    s.turns = 0;
    s.delta_position = {};
    s.delta_rotation = {};
}

/// What is left of a speed after a time h. damping: 1/s
[[nodiscard]] inline float decay(float damping, float h)
{
    return damping > 0 ? static_cast<float>(exponential(-static_cast<double>(damping) * static_cast<double>(h))) : 1.0f;
}

inline void set_constants(const StepContext& ctx, int body, StateConstants& c)
{
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    const MotionLocks locks = ctx.state.bodies[body].locks;
    const Vec2 g = sim.gravity_scale * ctx.state.gravity;
    c.inverse_mass = sim.inverse_mass;
    c.inverse_inertia = sim.inverse_inertia;
    c.acceleration = {(locks.linear_x ? 0 : g.x) + sim.inverse_mass.x * sim.force.x,
                      (locks.linear_y ? 0 : g.y) + sim.inverse_mass.y * sim.force.y};
    c.angular_acceleration = sim.inverse_inertia * sim.torque;
    c.linear_decay = decay(sim.linear_damping, ctx.h);
    c.angular_decay = decay(sim.angular_damping, ctx.h);
}

[[nodiscard]] ContactConstraint prepare_constraint(const StepContext& ctx, int contact, const Manifold& manifold, std::int32_t a,
                                                   std::int32_t b);
/// The state of a body as the island's constraints see it: all that does not move shares the first, kinematic bodies have a copy in every island. none: it
/// belongs to another island.
[[nodiscard]] std::int32_t state_for_constraints(const StepContext& ctx, const Island& island, int body);
/// A body in flight; joint: the hinge to the world that it turns on, or none.
[[nodiscard]] Flier make_flier(const StepContext& ctx, std::int32_t state, int body, int joint);

/// To which depth a contact with what does not give way may go: half of what is inside the other side. Boxes that were put deeper come out by themselves.
[[nodiscard]] float core_depth(const SceneState& state, const Contact& contact, const Manifold& manifold, bool a_gives);

/// Writes the points of a manifold taken at the bodies' present poses within the step into the constraint.
void set_constraint_geometry(const Scratch& scratch, ContactConstraint& constraint, const Manifold& manifold);

/// In small islands constraints are looked at anew within the step.
inline void follow_closely(const Contact& contact, const Island& island, ContactConstraint& constraint)
{
    const bool round = (contact.flags & contact_flag::round) != 0;
    constraint.refreshed = island.policy.recomputes_contacts && round;
    constraint.followed = island.policy.recomputes_contacts && !round;
}

/// A piece of a chain or an arc that has no point with a body now may have one before the step is over, as the body slides over a seam: in small
/// islands such contacts have constraints without points, that are looked at anew.
[[nodiscard]] inline bool may_come_to_face(const Contact& contact, const Island& island)
{
    return island.policy.recomputes_contacts && !means_apart(contact) && (contact.flags & contact_flag::round) == 0;
}

/// All impulses of the last sub-step, for a sub-step of another length.
void scale_constraint(ContactConstraint& constraint, float by);

} // namespace carom::internal
