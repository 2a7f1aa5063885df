// Contacts as soft constraints, solved by sequential impulses over sub-steps ("Soft Step", Catto 2023).
//
//   C  = n · (pb + rb - pa - ra) >= 0          separation, along the normal from a to b
//   dC = n · (vb + wb x rb - va - wa x ra)     J = (-n, -ra x n, n, rb x n)
//   impulse = -m mass_scale (dC + bias) - impulse_scale accumulated, accumulated impulse >= 0,   m = 1 / (J M^-1 J^T)
//
// Apart (C > 0), the contact is speculative with a bias of C / h: the bodies may close the gap in this sub-step but not more. Overlapping, the bias is
// the soft constraint's bias_rate C, no faster than the push speed. Friction: |tangent impulse| <= mu normal impulse, towards the surface speed.
//
// Constraints of round shapes in small islands also carry predicted_curvature: the error of the straight-line prediction of
// C over the sub-step, because the surfaces curve. It is corrected rigidly, as C / h. With the new normal of the relaxation,
// this makes the pair of passes the RATTLE integrator, which neither gains nor loses energy around a curve.

#include "dynamics/solver/contact/contact_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::internal {

void apply_impulse(BodyState& s, const StateConstants& c, Vec2 arm, Vec2 impulse)
{
    s.velocity.x += c.inverse_mass.x * impulse.x;
    s.velocity.y += c.inverse_mass.y * impulse.y;
    s.angular_velocity += c.inverse_inertia * cross(arm, impulse);
}

namespace {

struct Pair
{
    BodyState& sa;
    BodyState& sb;
    const StateConstants& ca;
    const StateConstants& cb;

    Pair(const SolverView& view, const ContactConstraint& constraint)
        : sa(view.states[constraint.a]), sb(view.states[constraint.b]), ca(view.constants[constraint.a]),
          cb(view.constants[constraint.b])
    {}

    [[nodiscard]] Vec2 relative_velocity(const ConstraintPoint& p) const
    {
        return sb.velocity + cross(sb.angular_velocity, p.rb) - sa.velocity - cross(sa.angular_velocity, p.ra);
    }

    void apply(const ConstraintPoint& p, Vec2 impulse) const
    {
        apply_impulse(sa, ca, p.ra, -impulse);
        apply_impulse(sb, cb, p.rb, impulse);
    }
};

void solve_rolling(const Pair& pair, ContactConstraint& constraint)
{
    const float updated =
        friction_impulse(constraint.rolling_impulse, constraint.rolling_mass, pair.sb.angular_velocity - pair.sa.angular_velocity,
                         constraint.rolling * load_of(constraint));
    const float change = updated - std::exchange(constraint.rolling_impulse, updated);
    pair.sa.angular_velocity -= pair.ca.inverse_inertia * change;
    pair.sb.angular_velocity += pair.cb.inverse_inertia * change;
}

void solve_friction(const Pair& pair, const ContactConstraint& constraint, ConstraintPoint& p)
{
    const Vec2 t = perp(constraint.n);
    const float slip = dot(pair.relative_velocity(p), t) - constraint.surface_speed;
    const float updated = friction_impulse(p.tangent_impulse, p.tangent_mass, slip, constraint.friction * p.normal_impulse);
    pair.apply(p, (updated - std::exchange(p.tangent_impulse, updated)) * t);
}

// Always inlined: three numbers are otherwise returned through memory, and the load stalls.
[[gnu::always_inline]] inline NormalTarget<float> target_of_normal(const SolverView& view, const ContactConstraint& constraint,
                                                                   const ConstraintPoint& p, bool use_bias)
{
    const float speed = dot(Pair(view, constraint).relative_velocity(p), constraint.n);
    const float separation = constraint_separation(view, constraint, p);
    if (!use_bias)
        return {speed, std::max(separation, 0.0f) * view.inverse_h, 1, 1};
    const float ahead = separation + p.predicted_curvature;
    if (ahead > 0)
        return {speed, ahead * view.inverse_h, 1, 1};
    const float soft = std::max(constraint.softness.bias_rate * std::min(separation, 0.0f), -view.push_speed);
    const float bent = soft + (separation > 0 ? ahead : p.predicted_curvature) * view.inverse_h;
    if (constraint.refreshed != 0)
        return {speed, bent, 1, 1};
    return {speed, bent, constraint.softness.mass_scale, 1 / constraint.softness.mass_scale};
}

void set_normal_impulse(const Pair& pair, const ContactConstraint& constraint, ConstraintPoint& p, float impulse)
{
    const float change = impulse - p.normal_impulse;
    p.normal_impulse = impulse;
    pair.apply(p, change * constraint.n);
}

void solve_normal(const SolverView& view, const Pair& pair, const ContactConstraint& constraint, ConstraintPoint& p,
                  bool use_bias)
{
    set_normal_impulse(pair, constraint, p,
                       normal_impulse(p.normal_mass, p.normal_impulse, target_of_normal(view, constraint, p, use_bias)));
}

void solve_both_normals(const SolverView& view, const Pair& pair, ContactConstraint& constraint, bool use_bias)
{
    ConstraintPoint& p = constraint.points[0];
    ConstraintPoint& q = constraint.points[1];
    const NormalImpulses<float> now =
        normal_impulses(1 / p.normal_mass, 1 / q.normal_mass, constraint.coupling, p.normal_impulse, q.normal_impulse,
                        target_of_normal(view, constraint, p, use_bias), target_of_normal(view, constraint, q, use_bias));
    set_normal_impulse(pair, constraint, p, now.first);
    set_normal_impulse(pair, constraint, q, now.second);
}

float median(float a, float b, float c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

} // namespace

float constraint_separation(const SolverView& view, const ContactConstraint& constraint, const ConstraintPoint& p)
{
    const BodyState& a = view.states[constraint.a];
    const BodyState& b = view.states[constraint.b];
    const Vec2 d = b.delta_position + rotate(b.delta_rotation, p.rb0) - a.delta_position - rotate(a.delta_rotation, p.ra0);
    return p.base + dot(d, constraint.n);
}

NormalTarget<float> normal_target(const SolverView& view, const ContactConstraint& constraint, const ConstraintPoint& p,
                                  bool use_bias)
{
    return target_of_normal(view, constraint, p, use_bias);
}

float constraint_slip(const SolverView& view, const ContactConstraint& constraint, const ConstraintPoint& p)
{
    return dot(Pair(view, constraint).relative_velocity(p), perp(constraint.n)) - constraint.surface_speed;
}

float constraint_speed(const SolverView& view, const ContactConstraint& constraint, const ConstraintPoint& p)
{
    return dot(Pair(view, constraint).relative_velocity(p), constraint.n);
}

void warm_start(const SolverView& view, std::span<ContactConstraint> constraints)
{
    for (ContactConstraint& constraint : constraints)
    {
        const Pair pair(view, constraint);
        for (int i = 0; i < constraint.count; ++i)
        {
            const ConstraintPoint& p = constraint.points[i];
            pair.apply(p, p.normal_impulse * constraint.n + p.tangent_impulse * perp(constraint.n));
        }
        pair.sa.angular_velocity -= pair.ca.inverse_inertia * constraint.rolling_impulse;
        pair.sb.angular_velocity += pair.cb.inverse_inertia * constraint.rolling_impulse;
    }
}

void solve_contact_constraints(const SolverView& view, std::span<ContactConstraint> constraints, bool use_bias)
{
    for (ContactConstraint& constraint : constraints)
    {
        const Pair pair(view, constraint);
        if (constraint.count == 2 && constraint.coupling != 0)
            solve_both_normals(view, pair, constraint, use_bias);
        else
            for (int i = 0; i < constraint.count; ++i)
                solve_normal(view, pair, constraint, constraint.points[i], use_bias);
        if (constraint.rolling > 0)
            solve_rolling(pair, constraint);
        for (int i = 0; i < constraint.count; ++i)
            solve_friction(pair, constraint, constraint.points[i]);
    }
}

void note_approach(const SolverView& view, ContactConstraint& constraint, float least_blow)
{
    const std::span points = std::span(constraint.points).first(static_cast<std::size_t>(constraint.count));
    constraint.halfway = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        ConstraintPoint& p = points[i];
        const float approach = -constraint_speed(view, constraint, p);
        const float separation = constraint_separation(view, constraint, p);
        const bool meets = is_halfway(separation, approach, view.h, least_blow);
        if (p.normal_impulse > 0 && meets)
            constraint.halfway = static_cast<std::uint8_t>(constraint.halfway | 1u << i);
        p.approach = p.normal_impulse > 0 && !meets ? 0 : approach;
        if (p.normal_impulse == 0 && 2 * separation > view.h * least_blow)
            forget_loads(p);
    }
    const bool goes_on = constraint.halfway != 0;
    for (ConstraintPoint& p : points)
    {
        if (!goes_on)
        {
            p.standing_load = median(p.older_impulse, p.last_impulse, p.normal_impulse);
            p.older_impulse = std::exchange(p.last_impulse, p.normal_impulse);
        }
        const bool has_paused = goes_on || p.normal_impulse == 0;
        p.missing_load = has_paused ? std::max(p.standing_load - p.normal_impulse, 0.0f) : 0;
    }
}

void carry_approach_on(const SolverView& view, ContactConstraint& constraint)
{
    for (ConstraintPoint& p : std::span(constraint.points).first(static_cast<std::size_t>(constraint.count)))
    {
        const float now = -constraint_speed(view, constraint, p);
        const float most = 0.5f * view.h * (p.approach + now);
        const float way = std::min(std::max(constraint_separation(view, constraint, p), 0.0f), most);
        const float square = p.approach * p.approach + 2 * (now - p.approach) * way / view.h;
        if (p.approach > 0)
            p.approach = std::sqrt(std::max(square, 0.0f));
    }
}

float approach_before(const Scratch& scratch, const ContactConstraint& constraint, const ConstraintPoint& p)
{
    const BodySpeeds& a = scratch.solver.speeds[static_cast<std::size_t>(constraint.a)];
    const BodySpeeds& b = scratch.solver.speeds[static_cast<std::size_t>(constraint.b)];
    return dot(a.velocity + cross(a.angular_velocity, p.ra) - b.velocity - cross(b.angular_velocity, p.rb), constraint.n);
}

} // namespace carom::internal
