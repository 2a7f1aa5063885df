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

// Solves two held rows as one block, with an exact 2x2 K. A direction in which nothing can move gets no impulse.
void solve_block(const JointBodies& bodies, JointRecord& joint, const JointRows& rows, const Softness& s, bool use_bias)
{
    const JointRow& x = rows.held[0];
    const JointRow& y = rows.held[1];
    const float bias = use_bias ? s.bias_rate : 0;
    const float bx = bodies.speed(x) + bias * x.error;
    const float by = bodies.speed(y) + bias * y.error;
    const float k11 = bodies.couple(x, x);
    const float k12 = bodies.couple(x, y);
    const float k22 = bodies.couple(y, y);
    const float det = k11 * k22 - k12 * k12;
    float jx = k11 > 0 ? bx / k11 : 0;
    float jy = k22 > 0 ? by / k22 : 0;
    if (det > 1e-6f * k11 * k22)
    {
        jx = (k22 * bx - k12 * by) / det;
        jy = (k11 * by - k12 * bx) / det;
    }
    float& of_x = joint.impulses[x.slot];
    float& of_y = joint.impulses[y.slot];
    const float mass_scale = use_bias ? s.mass_scale : 1;
    const float impulse_scale = use_bias ? s.impulse_scale : 0;
    jx = -mass_scale * jx - impulse_scale * of_x;
    jy = -mass_scale * jy - impulse_scale * of_y;
    of_x += jx;
    of_y += jy;
    bodies.apply(x, jx);
    bodies.apply(y, jy);
}

/// Parameters with which the rows are solved.
struct Pass
{
    const Softness& softness;
    float h;
    bool use_bias;
};

// Solves everything that acts along the axis as one law. The held rows, which were solved just before, keep their speeds.
void solve_free_axis(const JointBodies& bodies, JointRecord& joint, const JointWork& work, const Pass& pass)
{
    const JointRows& rows = work.rows;
    const float held = pass.use_bias ? pass.softness.mass_scale : 1;
    const float whole = bodies.couple(rows.axis, rows.axis);
    const auto k = static_cast<double>(whole + held * (rows.axis_inverse_mass - whole));
    if (!(k > 0))
        return;
    const AxisImpulses old = axis_impulses(joint);
    const AxisLaw law = pass.use_bias ? rows.acts.law_ahead(work.spring, pass.h) : rows.acts.law_now(old, work.bounce, pass.h);
    const double before = law.scope.sum(old);
    const double free_rate = static_cast<double>(bodies.speed(rows.axis)) - k * before;
    const AxisPiece piece = law.solve(free_rate, k);
    const double after = piece.keeps_its_rate() ? (piece.rate - free_rate) / k : piece.impulse(piece.rate);
    set_axis_impulses(joint, law.scope.merge(old, law.split(piece, after, piece.rate)));
    const auto change = static_cast<float>(after - before);
    bodies.apply_along_axis(rows, change, held);
    for (int i = 0; i < rows.held_count; ++i)
        joint.impulses[rows.held[i].slot] += change * held * rows.reaction[i];
}

void solve_held(const JointBodies& bodies, JointRecord& joint, const JointRow& row, const Pass& pass)
{
    float& accumulated = joint.impulses[row.slot];
    const Softness s = pass.use_bias ? pass.softness : Softness{};
    const float speed = bodies.speed(row) + s.bias_rate * row.error;
    const float updated = (1 - s.impulse_scale) * accumulated - bodies.mass(row) * s.mass_scale * speed;
    bodies.apply(row, updated - accumulated);
    accumulated = updated;
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
    const JointRecord& joint = ctx.state.joints[place.joint];
    JointWork work;
    work.joint = place.joint;
    work.a = place.a;
    work.b = place.b;
    if (ctx.subdivisions > 1)
    {
        for (float& impulse : ctx.state.joints[place.joint].impulses)
            impulse /= static_cast<float>(ctx.subdivisions);
    }
    work.yields = joint.yields;
    const JointArms arms = joint_arms(ctx.state, joint);
    work.ra0 = arms.a;
    work.rb0 = arms.b;
    work.gap0 = arms.gap;
    work.axis0 = joint.body_a == none ? joint.axis_a
                                      : rotate(ctx.state.sims[static_cast<std::size_t>(joint.body_a)].rotation, joint.axis_a);
    work.wraps = joint.kind == JointType::Prismatic;
    if (has_angle(joint))
        work.angle0 = hinge_angle(ctx.state, joint);
    const SolverView view{ctx.scratch.solver.states.data(), ctx.scratch.solver.constants.data(), ctx.h, 1 / ctx.h, 0};
    if (joint.kind == JointType::Spring)
        fit_spring(view, ctx.state, work);
    else if (joint.hertz > 0)
        fit_axis_spring(view, joint, island.all_direct, island.drifts, work);
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
        const JointRows& rows = work.rows;
        if ((!rows.has_axis() && rows.held_count == 0) || is_in_flight(view, work))
            continue;
        const JointRecord& joint = state.joints[work.joint];
        const JointBodies bodies(view, work);
        for (const JointRow& row : rows.holds())
            bodies.apply(row, joint.impulses[row.slot]);
        if (rows.has_axis())
            bodies.apply(rows.axis, axis_impulse(joint));
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
        if (work.rows.held_count == 2)
            solve_block(bodies, joint, work.rows, soft, use_bias);
        else if (work.rows.held_count == 1)
            solve_held(bodies, joint, work.rows.held[0], pass);
        if (work.rows.has_axis())
            solve_free_axis(bodies, joint, work, pass);
    }
}

void note_limit_approach(const SolverView& view, const SceneState& state, std::span<JointWork> joints)
{
    for (JointWork& work : joints)
    {
        const JointRecord& joint = state.joints[work.joint];
        if (joint.limit_restitution == 0 || is_in_flight(view, work))
            continue;
        const float speed = JointBodies(view, work).speed(work.rows.axis);
        work.approach[0] = joint.impulses[slot_lower] > 0 ? 0 : -speed;
        work.approach[1] = joint.impulses[slot_upper] > 0 ? 0 : speed;
    }
}

void bounce_off_limits(const SolverView& view, SceneState& state, std::span<JointWork> joints, DirectSolve& direct,
                       float rest_speed)
{
    bool any = false;
    for (JointWork& work : joints)
    {
        const JointRecord& joint = state.joints[work.joint];
        if (joint.limit_restitution == 0 || is_in_flight(view, work))
            continue;
        const float stopped[] = {joint.impulses[slot_lower], joint.impulses[slot_upper]};
        for (int i = 0; i < 2; ++i)
        {
            const float approach = work.approach[i];
            const float leave = joint.limit_restitution * approach;
            // A load on the stop ends so small a bounce within half the sub-step.
            const float pressed = work.rows.axis_inverse_mass * stopped[i] - approach;
            const bool bounces = stopped[i] > 0 && approach > rest_speed && leave > 0.5f * pressed;
            work.bounce[i] = bounces ? leave : 0;
            any |= bounces;
        }
    }
    if (!any)
        return;
    if (direct.is_ready())
        direct.bounce();
    for (JointWork& work : joints)
    {
        JointRecord& joint = state.joints[work.joint];
        for (int i = 0; i < 2; ++i)
        {
            const float leave = std::exchange(work.bounce[i], 0.0f);
            if (leave == 0)
                continue;
            joint.impulses[i == 0 ? slot_lower : slot_upper] = 0;
            if (direct.is_ready())
                continue;
            const JointBodies bodies(view, work);
            const float k = work.rows.axis_inverse_mass;
            const float wanted = i == 0 ? leave : -leave;
            bodies.apply_along_axis(work.rows, k > 0 ? (wanted - bodies.speed(work.rows.axis)) / k : 0);
        }
    }
}

void note_stops(const SolverView& view, const SceneState& state, std::span<const JointWork> joints)
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
        const JointRecord& joint = state.joints[work.joint];
        const bool a_stands = view.constants[work.a].inverse_inertia == 0;
        const bool b_stands = view.constants[work.b].inverse_inertia == 0;
        if (joint.kind != JointType::Revolute || !joint.enable_limit || a_stands == b_stands || is_in_flight(view, work))
            continue;
        std::uint16_t& flags = view.states[a_stands ? work.b : work.a].flags;
        if (work.pose.angle - joint.lower < tiny)
            flags |= a_stands ? body_flag::at_lower : body_flag::at_upper;
        if (joint.upper - work.pose.angle < tiny)
            flags |= a_stands ? body_flag::at_upper : body_flag::at_lower;
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
        for (const JointRow& row : work.rows.holds())
            work.add(row, joint.impulses[row.slot]);
        if (work.rows.has_axis())
            work.add(work.rows.axis, axis_impulse(joint));
        if (joint.kind == JointType::Spring && length(pose.gap) > 0)
            work.force_sum += joint.impulses[slot_spring] * normalize(pose.gap);
    }
    note_stops(view, state, joints);
}

} // namespace carom::internal
