// Joint rows by sequential impulses, with the same soft constraint as contacts. By default the rows are as stiff as a sub-step allows, and undamped (hertz
// 0.25 / h, damping ratio 0). This keeps 120 degree pendulums within 0.02 % of their period, where a damped default loses 2 % of the energy in a minute.
// The relaxation pass removes the speed that the position correction adds.

#include "dynamics/solver/joint/joint_solver.h"

#include "core/trigonometry.h"
#include "dynamics/solver/joint/springs.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

// --- solving -----------------------------------------------------------------------------------------------------------------------

/// Parameters with which the rows are solved.
struct Pass
{
    const Softness& softness;
    float h;
    bool use_bias;
};

// Solves everything that acts along an axis as one law. The held rows, which were solved just before, keep their speeds.
void solve_free_axis(const JointBodies& bodies, JointRecord& joint, const JointWork& work, const JointAxis& axis,
                     const Pass& pass)
{
    const std::span<const JointRow> held_rows = work.rows.holds();
    const AxisWork& own = work.axes[axis.number];
    const float held = pass.use_bias ? pass.softness.mass_scale : 1;
    const float whole = bodies.couple(axis.row, axis.row);
    const auto k = static_cast<double>(whole + held * (axis.inverse_mass - whole));
    if (!(k > 0))
        return;
    const AxisImpulses old = axis_impulses(joint, axis.number);
    const AxisLaw law = pass.use_bias ? axis.acts.law_ahead(own.spring, pass.h) : axis.acts.law_now(old, own.bounce, pass.h);
    const double before = law.scope.sum(old);
    const double free_rate = static_cast<double>(bodies.speed(axis.row)) - k * before;
    const AxisPiece piece = law.solve(free_rate, k);
    const double after = piece.keeps_its_rate() ? (piece.rate - free_rate) / k : piece.impulse(piece.rate);
    set_axis_impulses(joint, axis.number, law.scope.merge(old, law.split(piece, after, piece.rate)));
    const auto change = static_cast<float>(after - before);
    bodies.apply_along(axis, held_rows, change, held);
    for (std::size_t i = 0; i < held_rows.size(); ++i)
        joint.impulses[static_cast<std::size_t>(slot_held) + i] += change * held * axis.reaction[i];
}

// Solves the held rows as one block. A direction in which nothing can move gets no impulse.
void solve_held(const JointBodies& bodies, JointRecord& joint, const JointRows& rows, const Pass& pass)
{
    const Softness s = pass.use_bias ? pass.softness : Softness{};
    const std::span<const JointRow> held = rows.holds();
    float change[most_joint_rows];
    for (std::size_t i = 0; i < held.size(); ++i)
        change[i] = bodies.speed(held[i]) + s.bias_rate * held[i].error;
    bodies.block(held).solve(change);
    for (std::size_t i = 0; i < held.size(); ++i)
    {
        float& impulse = joint.impulses[static_cast<std::size_t>(slot_held) + i];
        change[i] = -s.mass_scale * change[i] - s.impulse_scale * impulse;
        impulse += change[i];
        bodies.apply(held[i], change[i]);
    }
}

} // namespace

JointArms joint_arms(const SceneState& state, const JointRecord& joint)
{
    const auto place = [&](int body, Vec2 anchor, Vec2& arm)
    {
        if (body == none)
            return Position(anchor);
        const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
        arm = rotate(sim.rotation, anchor - sim.local_center);
        return sim.center + arm;
    };
    JointArms arms;
    const Position a = place(joint.body_a, joint.anchor_a, arms.a);
    arms.gap = place(joint.body_b, joint.anchor_b, arms.b) - a;
    return arms;
}

JointWork prepare_joint(const StepContext& ctx, const Island& island, const SolvedJoint& place)
{
    JointRecord& joint = ctx.state.joints[place.joint];
    JointWork work;
    work.joint = place.joint;
    work.a = place.a;
    work.b = place.b;
    if (ctx.subdivisions > 1)
    {
        for (float& impulse : joint.impulses)
            impulse /= static_cast<float>(ctx.subdivisions);
    }
    work.yields = joint.yields;
    const JointArms arms = joint_arms(ctx.state, joint);
    work.ra0 = arms.a;
    work.rb0 = arms.b;
    work.gap0 = arms.gap;
    work.axis0 = joint.body_a == none ? joint.axis_a
                                      : rotate(ctx.state.sims[static_cast<std::size_t>(joint.body_a)].rotation, joint.axis_a);
    const SolverView view{ctx.scratch.solver.states.data(), ctx.scratch.solver.constants.data(), ctx.h, 1 / ctx.h, 0};
    joint.has_row = joint.kind != JointType::Spring || (island.all_direct && !has_exact_kicks(view, ctx.state, work));
    JointPose pose{.ra = work.ra0, .rb = work.rb0, .gap = work.gap0, .axis = work.axis0};
    const JointRows rows = rows_at(joint, pose);
    const auto is_angle = [](const JointRow& row) { return row.is_angle; };
    work.wraps = std::ranges::any_of(rows.holds(), is_angle);
    work.needs_angle = work.wraps || std::ranges::any_of(rows.axes(), is_angle, &JointAxis::row);
    if (work.needs_angle)
        work.angle0 = work.wraps ? shortest_angle(ctx.state, joint) : hinge_angle(ctx.state, joint);
    if (!joint.has_row)
        fit_spring(view, ctx.state, work);
    else if (joint.kind == JointType::Spring)
        work.axes[0].spring = {.stiffness = joint.stiffness, .damping = joint.damping, .theta = 0.5f};
    else if (joint.hertz > 0)
        fit_axis_springs(view, joint, rows, island.all_direct, island.drifts, work);
    return work;
}

void warm_start_joints(const SolverView& view, SceneState& state, std::span<JointWork> joints, DirectSolve& direct)
{
    if (direct.is_ready())
    {
        direct.warm_start();
        return;
    }
    for (const JointWork& work : joints)
    {
        if (work.rows.count() == 0 || is_in_flight(view, work))
            continue;
        const JointRecord& joint = state.joints[work.joint];
        const JointBodies bodies(view, work);
        for (int i = 0; i < work.rows.count(); ++i)
            bodies.apply(work.rows.row(i), impulse_of(joint, work.rows, i));
    }
}

void solve_joints(const SolverView& view, SceneState& state, std::span<JointWork> joints, DirectSolve& direct, float joint_hertz,
                  bool use_bias)
{
    if (direct.is_ready())
    {
        direct.solve(use_bias);
        return;
    }
    const Softness soft = make_softness(joint_hertz, 0, view.h);
    const Pass pass{soft, view.h, use_bias};
    for (const JointWork& work : joints)
    {
        if (is_in_flight(view, work))
            continue;
        JointRecord& joint = state.joints[work.joint];
        const JointBodies bodies(view, work);
        solve_held(bodies, joint, work.rows, pass);
        for (const JointAxis& axis : work.rows.axes())
            solve_free_axis(bodies, joint, work, axis, pass);
    }
}

void note_limit_approach(const SolverView& view, const SceneState& state, std::span<JointWork> joints)
{
    for (JointWork& work : joints)
    {
        const JointRecord& joint = state.joints[work.joint];
        if (joint.limit_restitution == 0 || is_in_flight(view, work))
            continue;
        for (const JointAxis& axis : work.rows.axes())
        {
            const float speed = JointBodies(view, work).speed(axis.row);
            const AxisImpulses borne = axis_impulses(joint, axis.number);
            AxisWork& own = work.axes[axis.number];
            own.approach[0] = borne.lower > 0 ? 0 : -speed;
            own.approach[1] = borne.upper > 0 ? 0 : speed;
        }
    }
}

namespace {

// Finds the speeds at which an axis is to leave its limits. True if there are any.
bool find_bounces(const JointRecord& joint, const JointAxis& axis, float rest_speed, AxisWork& own)
{
    const AxisImpulses borne = axis_impulses(joint, axis.number);
    const float stopped[] = {static_cast<float>(borne.lower), static_cast<float>(borne.upper)};
    bool any = false;
    for (int i = 0; i < 2; ++i)
    {
        const float approach = own.approach[i];
        const float leave = joint.limit_restitution * approach;
        // A load on the stop ends so small a bounce within half the sub-step.
        const float pressed = axis.inverse_mass * stopped[i] - approach;
        const bool bounces = stopped[i] > 0 && approach > rest_speed && leave > 0.5f * pressed;
        own.bounce[i] = bounces ? leave : 0;
        any |= bounces;
    }
    return any;
}

// Gives an axis the speeds at which it is to leave its limits; has_given: the direct solve has done it.
void give_bounces(const JointBodies& bodies, JointRecord& joint, const JointRows& rows, const JointAxis& axis, AxisWork& own,
                  bool has_given)
{
    for (int i = 0; i < 2; ++i)
    {
        const float leave = std::exchange(own.bounce[i], 0.0f);
        if (leave == 0)
            continue;
        joint.impulses[slot_of_axis(axis.number, i == 0 ? slot_lower : slot_upper)] = 0;
        const float wanted = i == 0 ? leave : -leave;
        if (!has_given && axis.inverse_mass > 0)
            bodies.apply_along(axis, rows.holds(), (wanted - bodies.speed(axis.row)) / axis.inverse_mass);
    }
}

} // namespace

void bounce_off_limits(const SolverView& view, SceneState& state, std::span<JointWork> joints, DirectSolve& direct,
                       float rest_speed)
{
    bool any = false;
    for (JointWork& work : joints)
    {
        const JointRecord& joint = state.joints[work.joint];
        if (joint.limit_restitution == 0 || is_in_flight(view, work))
            continue;
        for (const JointAxis& axis : work.rows.axes())
            any |= find_bounces(joint, axis, rest_speed, work.axes[axis.number]);
    }
    if (!any)
        return;
    if (direct.is_ready())
        direct.bounce();
    for (JointWork& work : joints)
    {
        for (const JointAxis& axis : work.rows.axes())
            give_bounces(JointBodies(view, work), state.joints[work.joint], work.rows, axis, work.axes[axis.number],
                         direct.is_ready());
    }
}

void note_stops(const SolverView& view, std::span<const JointWork> joints)
{
    constexpr float tiny = 1e-3f; // rad
    constexpr std::uint16_t stops = body_flag::at_lower | body_flag::at_upper;
    for (const JointWork& work : joints)
    {
        for (const std::int32_t s : {work.a, work.b})
            view.states[s].flags = static_cast<std::uint16_t>(view.states[s].flags & ~stops);
    }
    for (const JointWork& work : joints)
    {
        const bool a_stands = view.constants[work.a].inverse_inertia == 0;
        const bool b_stands = view.constants[work.b].inverse_inertia == 0;
        if (a_stands == b_stands || is_in_flight(view, work))
            continue;
        std::uint16_t& flags = view.states[a_stands ? work.b : work.a].flags;
        for (const JointAxis& axis : work.rows.axes())
        {
            if (!axis.row.is_angle)
                continue;
            if (axis.acts.has_lower && axis.acts.lower_error < tiny)
                flags |= a_stands ? body_flag::at_lower : body_flag::at_upper;
            if (axis.acts.has_upper && axis.acts.upper_error < tiny)
                flags |= a_stands ? body_flag::at_upper : body_flag::at_lower;
        }
    }
}

void finish_joint_substep(const SolverView& view, SceneState& state, std::span<JointWork> joints)
{
    for (JointWork& work : joints)
    {
        if (is_in_flight(view, work))
            continue;
        const JointRecord& joint = state.joints[work.joint];
        const JointPose& pose = work.pose;
        for (int i = 0; i < work.rows.count(); ++i)
            work.add(work.rows.row(i), impulse_of(joint, work.rows, i));
        if (!joint.has_row && length(pose.gap) > 0)
            work.force_sum += joint.impulses[slot_spring] * normalize(pose.gap);
    }
    note_stops(view, joints);
}

} // namespace carom::internal
