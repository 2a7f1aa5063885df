#pragma once

// Prepares states, constants and constraints for the solver from the records.

#include "core/trigonometry.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Writes field by field in place: copying a record that was just written that way would stall on store forwarding.
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

/// The share of a speed that is left after a time h. damping: 1/s
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
/// The index of a body's state as the island's constraints see it. All fixed and sleeping bodies share the
/// first state; kinematic bodies have a copy in every island. none: the body belongs to another island.
[[nodiscard]] std::int32_t state_for_constraints(const StepContext& ctx, const Island& island, int body);
/// A body in flight. joint: the hinge to the world about which it turns, or none.
[[nodiscard]] Flier make_flier(const StepContext& ctx, std::int32_t state, int body, int joint);

/// The depth that a contact with an immovable body may reach: half of the inner radius of the other side. Boxes that were put deeper come out by themselves.
[[nodiscard]] float core_depth(const SceneState& state, const Contact& contact, const Manifold& manifold, bool a_gives);

/// The rolling resistance of a contact as a length: coefficient times the radius of the rolling shape, m.
[[nodiscard]] float rolling_length(const SceneState& state, const Contact& contact);

/// Writes the points of a manifold taken at the bodies' present poses within the step into the constraint.
void set_constraint_geometry(const Scratch& scratch, ContactConstraint& constraint, const Manifold& manifold);

/// Turns the arms of a constraint to the orientation from which rotations count, where that is the middle of the step.
void turn_arms(const Scratch& scratch, ContactConstraint& constraint);

/// In small islands constraints are recomputed within the step.
inline void follow_closely(const Contact& contact, const Island& island, ContactConstraint& constraint)
{
    const bool round = (contact.flags & contact_flag::round) != 0;
    constraint.refreshed = island.policy.recomputes_contacts && round;
    constraint.followed = island.policy.recomputes_contacts && !round;
}

/// A piece of a chain or an arc that has no point with a body now may get one within the step, as the body
/// slides over a seam. In small islands such contacts have constraints without points, which are recomputed.
[[nodiscard]] inline bool may_come_to_face(const Contact& contact, const Island& island)
{
    return island.policy.recomputes_contacts && !means_apart(contact) && (contact.flags & contact_flag::round) == 0;
}

/// Scales all impulses of the last sub-step to a sub-step of another length.
void scale_constraint(ContactConstraint& constraint, float by);

} // namespace carom::internal
