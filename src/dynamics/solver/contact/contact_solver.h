#pragma once

// The passes over contact constraints. Each takes the constraints of one island; h is the sub-step.

#include "dynamics/solver/contact/contact_equations.h"
#include "dynamics/step_context.h"

#include <span>

namespace carom::internal {

struct SolverView
{
    BodyState* states;
    const StateConstants* constants;
    float h;
    float inverse_h;
    float push_speed;
};

/// Displacement of a body's center in the sub-step. A body that no contact, limit or motor
/// holds follows its exact parabola, by the mean of the velocities before and after.
[[nodiscard]] inline Vec2 drift(const SolverView& view, std::int32_t state)
{
    const BodyState& s = view.states[state];
    const Vec2 straight = view.h * s.velocity;
    if ((s.flags & body_flag::unbound) == 0)
        return straight;
    return straight - (0.5f * view.h * view.h) * view.constants[state].acceleration;
}

void warm_start(const SolverView& view, std::span<ContactConstraint> constraints);

/// One pass of sequential impulses: the normal direction, then rolling and friction within the load just found. With bias the soft constraint also
/// removes overlap; without it ("relax") the pass only stops approach, which takes out the speed that the bias put in.
void solve_contact_constraints(const SolverView& view, std::span<ContactConstraint> constraints, bool use_bias);

[[nodiscard]] NormalTarget<float> normal_target(const SolverView& view, const ContactConstraint& constraint,
                                                const ConstraintPoint& point, bool use_bias);
/// The speed of b's surface relative to a's along perp(n), less the surface speed, m/s.
[[nodiscard]] float constraint_slip(const SolverView& view, const ContactConstraint& constraint, const ConstraintPoint& point);

/// Whether a point that has been stopped in part still approaches: the bodies meet within the next sub-step of h.
[[nodiscard]] inline bool is_halfway(float separation, float approach, float h, float least_blow)
{
    return approach > least_blow && 2 * separation > h * approach;
}
/// Before the sub-step's forces, notes the approach speeds of points that bear no load yet or have not met: a constraint takes a part of an approach up to a
/// sub-step early and leaves so much that the bodies meet at the end of the next one. Standing loads are those before such a blow.
void note_approach(const SolverView& view, ContactConstraint& constraint, float least_blow);

/// After the forces, carries the approach speeds on to where bodies meet: with a = (u1 - u0) / h while they come nearer by s, u² = u0² + 2 a s. They may
/// meet in the next sub-step only, which the relaxation foresees.
void carry_approach_on(const SolverView& view, ContactConstraint& constraint);

/// The approach speed when the sub-step began, along the present normal of the constraint.
[[nodiscard]] float approach_before(const Scratch& scratch, const ContactConstraint& constraint, const ConstraintPoint& point);

[[nodiscard]] float constraint_separation(const SolverView& view, const ContactConstraint& constraint,
                                          const ConstraintPoint& point);
/// The rate at which the separation grows, m/s.
[[nodiscard]] float constraint_speed(const SolverView& view, const ContactConstraint& constraint, const ConstraintPoint& point);

void apply_impulse(BodyState& state, const StateConstants& constants, Vec2 arm, Vec2 impulse);

} // namespace carom::internal
