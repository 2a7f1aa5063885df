#include "dynamics/solver/bounce/impact_event.h"

#include "core/index.h"
#include "dynamics/solver/effective_mass.h"

#include <span>

namespace carom::internal {

namespace {

Vec2 velocity_at(const BodySpeeds& s, Vec2 arm) { return s.velocity + cross(s.angular_velocity, arm); }

// The effective mass of a body at the arm's end along n; 0 where it cannot move.
float point_mass(const StateConstants& c, Vec2 n, Vec2 arm)
{
    const ImpulseLine<float> line{n.x, n.y, cross(arm, n)};
    const float inverse = response(c.inverse(), line, line);
    return exceeds_rounding(inverse, dot(arm, arm) * c.inverse_inertia) ? 1 / inverse : 0;
}

} // namespace

Position place_on_a(const StepContext& ctx, const SolverView& view, const ContactConstraint& constraint, Vec2 arm)
{
    const Contact& contact = ctx.state.contacts[constraint.contact];
    return ctx.state.sims[as_index(contact.body_a)].center + view.states[constraint.a].delta_position + arm;
}

void fill_impact(const StepContext& ctx, const SolverView& view, const ContactConstraint& constraint, ImpactEvent& event)
{
    Vec2 arm_a{};
    Vec2 arm_b{};
    for (const ConstraintPoint& p : std::span(constraint.points).first(as_index(constraint.count)))
    {
        if (p.approach <= 0 || p.normal_impulse <= 0)
            continue;
        event.impulse += p.normal_impulse;
        event.friction_impulse += p.tangent_impulse;
        arm_a += p.normal_impulse * p.ra;
        arm_b += p.normal_impulse * p.rb;
    }
    if (event.impulse <= 0)
        return;
    arm_a *= 1 / event.impulse;
    arm_b *= 1 / event.impulse;
    const auto now_at = [&](std::int32_t state, Vec2 arm)
    { return velocity_at({view.states[state].velocity, view.states[state].angular_velocity}, arm); };
    event.normal = constraint.n;
    event.point = place_on_a(ctx, view, constraint, arm_a);
    event.velocity_a = velocity_at(ctx.scratch.solver.speeds[as_index(constraint.a)], arm_a);
    event.velocity_b = velocity_at(ctx.scratch.solver.speeds[as_index(constraint.b)], arm_b);
    event.velocity_after_a = now_at(constraint.a, arm_a);
    event.velocity_after_b = now_at(constraint.b, arm_b);
    event.speed_a = dot(event.velocity_a, constraint.n);
    event.speed_b = dot(event.velocity_b, constraint.n);
    event.approach_speed = event.speed_a - event.speed_b;
    event.effective_mass_a = point_mass(view.constants[constraint.a], constraint.n, arm_a);
    event.effective_mass_b = point_mass(view.constants[constraint.b], constraint.n, arm_b);
    const Vec2 impulse = event.impulse * constraint.n + event.friction_impulse * perp(constraint.n);
    event.energy_lost =
        -0.5f * dot(impulse, event.velocity_b - event.velocity_a + event.velocity_after_b - event.velocity_after_a);
}

} // namespace carom::internal
