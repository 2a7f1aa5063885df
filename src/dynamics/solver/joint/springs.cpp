// The exact motion of one mass on one spring. With e the stretch, u its rate, a the constant acceleration by everything else (already in the velocities as
// h a), w² = k / m and B(t) the response to a unit of speed, the motion over a sub-step is
//
//   e' = A e + B u + G a      A = 1 - w² G,  G = integral of B over h
//   u' = -w² B e + D u + B a  D = dB/dt
//
// The first kick makes the straight drift end at e'. The second kick makes the speed u', from where the drift has in fact ended. Frequency, decay, rest
// position and energy come out right at any sub-step.

#include "dynamics/solver/joint/springs.h"

#include "core/trigonometry.h"
#include "dynamics/state/body_store.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

constexpr float most_line_turn =
    0.02f; // rad, in a sub-step: the motion along a line that turns faster is not that of a mass on a spring

// Response to a unit of speed after h: the displacement (B), its rate (D) and its integral (G); and A.
struct SpringAnswer
{
    double b;
    double d;
    double g;
    double a;
};

SpringAnswer pure_damper(double rate, double h)
{
    if (rate * h < 1e-9)
        return {h, 1, 0.5 * h * h, 1};
    const double fade = exponential(-rate * h);
    const double b = (1 - fade) / rate;
    return {b, fade, (h - b) / rate, 1};
}

SpringAnswer answer_of(double stiffness, double damping, double mass, double h)
{
    if (stiffness == 0)
        return pure_damper(damping / mass, h);
    const double w2 = stiffness / mass;
    const double decay = damping / (2 * mass);
    const double d2 = w2 - decay * decay;
    double b;
    double even; // cos or cosh, decayed
    if (d2 > 0)
    {
        const double w = std::sqrt(d2);
        const double fade = exponential(-decay * h);
        const SinCos q = sin_cos(w * h);
        b = fade * q.sin / w;
        even = fade * q.cos;
    }
    else
    {
        const double r = std::sqrt(-d2);
        const double slow = exponential((r - decay) * h);
        const double fast = exponential((-r - decay) * h);
        b = r > 0 ? (slow - fast) / (2 * r) : h * slow;
        even = 0.5 * (slow + fast);
    }
    const double a = even + decay * b;
    return {b, even - decay * b, (1 - a) / w2, a};
}

struct SpringRow
{
    JointRow row;
    float mass = 0;
};

SpringRow spring_row(const SolverView& view, const JointRecord& joint, const JointWork& work)
{
    const JointPose pose = present_pose(view, work);
    const float l = length(pose.gap);
    if (!(l > 0))
        return {};
    const JointRow row = line_row((1 / l) * pose.gap, pose, l - joint.upper);
    return {row, JointBodies(view, work).mass(row)};
}

SpringKick make_kick(double stretch, double speed, double acceleration, double straight)
{
    return {static_cast<float>(stretch), static_cast<float>(speed), static_cast<float>(acceleration),
            static_cast<float>(straight)};
}

void fit_exactly(const SpringAnswer& s, double w2, double h, JointWork& work)
{
    // h (u + h a + kick) - h² a / 2 = e' - e; the present speed is u + h a. A body that drifts along a straight line has no term h² a / 2.
    const double by_speed = (s.b - h) / h;
    work.before = make_kick((s.a - 1) / h, by_speed, (s.g - 0.5 * h * h) / h - by_speed * h, -0.5 * h);
    // The state before the drift: e = e' - h v + h² a / 2 with v the present speed, u = (e' - A e - G a) / B.
    const double v_of_e = s.d / s.b;
    const double by_e = -w2 * s.b - v_of_e * s.a; // coefficient of e in u'
    work.after = make_kick(v_of_e + by_e, -h * by_e - 1, 0.5 * h * h * by_e + s.b - v_of_e * s.g, -0.5 * h * h * by_e);
}

// For a spring too stiff for the exact step: an implicit step, stable at any stiffness, in the first kick alone.
void fit_implicitly(double stiffness, double damping, double mass, double h, JointWork& work)
{
    const double p = 1 / (1 + (h * damping + h * h * stiffness) / mass);
    work.before = make_kick(-p * h * stiffness / mass, p - 1, 0, 0);
    work.after = {};
}

int count_springs(const SceneState& state, int body)
{
    int count = 0;
    if (body != none)
        for_each_joint(state, body, [&](int joint) { count += state.joints[joint].kind == JointType::Spring ? 1 : 0; });
    return count;
}

float kick(const SolverView& view, const JointRecord& joint, const JointWork& work, const SpringKick& kick)
{
    const SpringRow spring = spring_row(view, joint, work);
    const JointBodies bodies(view, work);
    const JointRow& row = spring.row;
    const float acceleration = dot(row.d, bodies.cb.acceleration - bodies.ca.acceleration) +
                               row.arm_b * bodies.cb.angular_acceleration - row.arm_a * bodies.ca.angular_acceleration;
    const auto straight = [&](std::int32_t state)
    { return (view.states[state].flags & body_flag::unbound) == 0 ? view.constants[state].acceleration : Vec2{}; };
    const float impulse =
        spring.mass * (kick.stretch * row.error + kick.speed * bodies.speed(row) + kick.acceleration * acceleration +
                       kick.straight * dot(row.d, straight(work.b) - straight(work.a)));
    bodies.apply(row, impulse);
    return impulse;
}

// The inverse inertia of a body on a hinge: 1 / (I + m r²).
float inverse_inertia_about(const StateConstants& c, Vec2 arm)
{
    const float r2 = dot(arm, arm);
    return r2 > 0 ? c.inverse_inertia / (1 + r2 * c.inverse_inertia / c.inverse_mass.x) : c.inverse_inertia;
}

// Independent of the poses within the step, so that the spring has an energy.
float inverse_spring_mass(const JointBodies& bodies, const JointRow& row, const JointWork& work)
{
    if (row.is_angle)
        return inverse_inertia_about(bodies.ca, work.ra0) + inverse_inertia_about(bodies.cb, work.rb0);
    const Vec2 k = bodies.ca.inverse_mass + bodies.cb.inverse_mass;
    return k.x * row.d.x * row.d.x + k.y * row.d.y * row.d.y;
}

// Applies the rest of the impulses that springs along axes give in the sub-step.
void kick_along_axes(const SolverView& view, const JointRecord& joint, JointWork& work)
{
    const JointBodies bodies(view, work);
    JointRows rows = rows_at(joint, present_pose(view, work));
    weigh_rows(bodies, rows);
    for (const JointAxis& axis : rows.axes())
    {
        AxisWork& own = work.axes[axis.number];
        if (!own.spring.acts_after())
            continue;
        const float impulse = own.spring.share_after() * joint.impulses[slot_of_axis(axis.number, slot_spring)];
        if (std::exchange(own.has_mean, false))
            bodies.apply(own.mean, impulse);
        else
            bodies.apply_along(axis, rows.holds(), impulse);
        work.add(axis.row, impulse);
    }
}

// h² k / m, summed over the springs of a body, must stay below 1.
bool is_followed(const SolverView& view, const JointRecord& joint, float mass, int springs)
{
    const auto h = static_cast<double>(view.h);
    return h * h * static_cast<double>(joint.stiffness) * springs <= 0.9 * static_cast<double>(mass);
}

// True for a body that does not move, and for one that this spring alone holds.
bool has_no_other_joint(const SceneState& state, int body)
{
    if (body == none || !is_moving_dynamic(state, body))
        return true;
    const std::int32_t first = state.bodies[body].first_joint;
    return state.joints[first >> 1].next[first & 1] == none;
}

} // namespace

bool has_exact_kicks(const SolverView& view, const SceneState& state, const JointWork& work)
{
    const JointRecord& joint = state.joints[work.joint];
    if (!has_no_other_joint(state, joint.body_a) || !has_no_other_joint(state, joint.body_b))
        return false;
    const JointBodies bodies(view, work);
    const Vec2 across = perp(work.gap0);
    const float speed = bodies.speed({.d = across, .arm_a = cross(work.ra0, across), .arm_b = cross(work.rb0, across)});
    return view.h * std::fabs(speed) < most_line_turn * dot(across, across) &&
           is_followed(view, joint, spring_row(view, joint, work).mass, 1);
}

void fit_spring(const SolverView& view, const SceneState& state, JointWork& work)
{
    const JointRecord& joint = state.joints[work.joint];
    const float m = spring_row(view, joint, work).mass;
    if (!(m > 0))
        return;
    const auto h = static_cast<double>(view.h);
    const auto mass = static_cast<double>(m);
    const auto stiffness = static_cast<double>(joint.stiffness);
    const auto damping = static_cast<double>(joint.damping);
    if (is_followed(view, joint, m, std::max(count_springs(state, joint.body_a), count_springs(state, joint.body_b))))
        fit_exactly(answer_of(stiffness, damping, mass, h), stiffness / mass, h, work);
    else
        fit_implicitly(stiffness, damping, mass, h, work);
}

void fit_axis_springs(const SolverView& view, const JointRecord& joint, const JointRows& rows, bool direct, bool drifts,
                      JointWork& work)
{
    for (const JointAxis& axis : rows.axes())
    {
        const float k = inverse_spring_mass(JointBodies(view, work), axis.row, work);
        if (!(k > 0))
            continue;
        AxisSpring& spring = work.axes[axis.number].spring;
        spring = make_spring(joint.hertz, joint.damping_ratio, 1 / k, view.h, direct ? direct_spring_turn : soft_spring_turn);
        if (axis.acts.soft_limits || !drifts)
            spring.theta = 1;
    }
}

void kick_springs_before(const SolverView& view, SceneState& state, std::span<JointWork> joints)
{
    for (const JointWork& work : joints)
    {
        JointRecord& joint = state.joints[work.joint];
        if (!joint.has_row)
            joint.impulses[slot_spring] = kick(view, joint, work, work.before);
    }
}

void kick_springs_after(const SolverView& view, SceneState& state, std::span<JointWork> joints)
{
    for (JointWork& work : joints)
    {
        JointRecord& joint = state.joints[work.joint];
        if (!joint.has_row)
            joint.impulses[slot_spring] += kick(view, joint, work, work.after);
        else if (std::ranges::any_of(work.axes, [](const AxisWork& axis) { return axis.spring.acts_after(); }))
            kick_along_axes(view, joint, work);
    }
}

} // namespace carom::internal
