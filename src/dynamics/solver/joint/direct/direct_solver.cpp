// The joints of a small island, all at once. Solved row by row, they never agree: a double pendulum loses 6 % of its energy in a minute.
//
//   C_i = error of row i at the pose that the present velocities lead to
//   sum over j of J_i M^-1 J_j^T lambda_j = -C_i / h,  by Newton's method; in the relaxation J v = 0 at the pose reached
//
// With the drift along parabolas that is the RATTLE integrator, which neither gains nor loses energy. joint_matrix.cpp solves the equations.
//
// A free axis has a row too. Its law (joint_axis.h) is piecewise linear: on each piece the row keeps a rate, gives a known impulse, or has the compliance
// of a spring. All axes are solved with the pieces that they seem to be on, until each is on the piece that its law has at the rate and impulse found:
// an active-set method. Springs, motors and stops thus act on the whole mechanism, at any stiffness and any number of joints.
//
// A load that stretches a body between its joints makes it swing like a taut string, with omega² = f · r / I for the pull f at the arm r. A sub-step can
// follow that only while omega h is below 1. Beyond it, a body of a tree gets a larger inertia, by just as much as is needed. The rows of a loop, which a
// taut chain stretches without bound, yield instead: their compliance grows with the third power of the stretch, because the pull falls with that power.
// The compliance then falls by at most half per sub-step, so that the gap that it has left is not closed at once.
//
// Joints of a loop may contradict each other, and so may those of a body that is locked along a line. Where they agree, a compliance of 2e-5 of a row's
// weight shares the load among redundant rows, and none is seen. With the error that they act on it grows, up to 1e-3: that bounds the impulses that they
// bear, if the error is bounded; one that is large compared with the arms turns bodies to where it is a different one.
//
// No impulse is right where a wall holds a body that joints pull: joints and contacts would outbid each other without end. The joints then yield, as they do
// where they stay far apart. Their compliance is then as great as their bodies' inverse masses. With that, alternating passes over joints and contacts
// converge to one small pull, and what has opened closes slowly.

#include "dynamics/solver/joint/direct/direct_solver.h"

#include "core/as_double.h"
#include "core/index.h"
#include "dynamics/state/scene_data.h"
#include "dynamics/state/turns.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace carom::internal {

namespace {

constexpr double most_gap = 0.01;  // in arms: wider gaps made outside the solver are closed by moving bodies, without speed
constexpr double most_pull = 0.25; // in arms, or rad: rows that may contradict each other act as if their error were no larger
constexpr double most_contradiction = 0.5; // likewise: joints whose error stays larger yield
constexpr int newton_steps = 2;
constexpr int most_newton_steps = 6;
constexpr int most_spring_steps = 16; // where lines turn far
constexpr double converged = 1e-6;    // in arms, or rad: redundant rows of loops share the remaining error
constexpr double most_softening = 400;

Triple velocity(const BodyState& s) { return as_triple(s.velocity, s.angular_velocity); }

} // namespace

void DirectSolve::prepare(const SolverView& view, SceneState& state, std::span<JointWork> joints, Masses masses)
{
    m_mass_kind = masses;
    m_view = view;
    m_state = &state;
    m_joints = joints;
    m_turns_too_far = false;
    m_spring_softening = 1;
    m_yields = std::ranges::any_of(joints, &JointWork::yields);
    if (std::exchange(m_looks_again, false))
        find_edges();
    m_fits = m_is_wanted && !m_edges.empty();
    m_ready = m_fits;
    if (m_ready && place())
    {
        m_matrix.fill(m_jacobians, m_masses);
        m_factored_with = -1;
    }
    if (m_ready && masses == Masses::Loaded)
        find_sprung_lines();
    if (m_ready && m_may_contradict)
        m_softening =
            std::clamp(std::max(m_softening, 0.5 * present_compliance() / loop_compliance), m_least_softening, most_softening);
}

// --- passes -------------------------------------------------------------------------------------------------------------------------

void DirectSolve::yield()
{
    m_yields = true;
    m_turns_too_far = false;
    for (JointWork& work : m_joints)
        work.yields = true;
}

void DirectSolve::solve(bool use_bias)
{
    if (use_bias && !m_yields && find_pose_ahead())
        return;
    const Stage stage = use_bias && m_yields ? Stage::Soft : Stage::Now;
    if (stage == Stage::Soft)
        straighten_springs();
    note_speeds();
    if (m_may_contradict)
        soften_to(largest_error());
    if (stage == Stage::Soft)
        close_slowly();
    take_step(stage);
}

void DirectSolve::take_step(Stage stage)
{
    if (stage == Stage::Ahead && m_may_contradict)
        limit_speeds();
    find_impulses(stage);
    take_velocities();
    take_impulses();
}

// Newton steps do not converge where a sub-step turns a body so far that no straight path ends at the right pose.
bool DirectSolve::find_pose_ahead()
{
    note_errors_ahead();
    if (largest_error() > 1)
    { // the impulses of the last sub-step are a bad start now
        start_anew();
        note_errors_ahead();
    }
    const double before = largest_error();
    soften_to(before);
    m_turns_too_far = (before > 1 && !m_may_contradict) || largest_gap() > most_gap;
    if (m_turns_too_far)
        return false;
    m_spring_softening = 1;
    for (;;)
    {
        take_step(Stage::Ahead);
        const double turn = largest_turn();
        note_errors_ahead();
        const double after = largest_error();
        const bool parts = m_may_contradict && m_softening < 1 && after > before; // the rows are next to contradicting each other
        m_turns_too_far = after > 1e-3 && (parts || after > 0.5 * std::max(before, turn));
        const bool contradicts = m_may_contradict && after > most_contradiction;
        if (!m_turns_too_far || (m_may_contradict && !contradicts && !may_soften()))
            break;
        take_back();
        if (!may_soften())
        {
            if (m_spring_softening > 1 || contradicts) // nor may the earlier impulses of springs remain
                start_anew();
            if (contradicts)
                yield();
            return false;
        }
        soften();
        note_errors_ahead();
    }
    m_turns_too_far = false;
    double left = largest_error();
    for (int i = 1; i < newton_steps || (i < most_newton_steps && left > converged) ||
                    (i < most_spring_steps && spring_change() > converged);
         ++i)
    {
        take_step(Stage::Ahead);
        note_errors_ahead();
        const double before_this = std::exchange(left, largest_error());
        if (i >= newton_steps && before_this > converged && left > 0.5 * before_this)
        { // the steps no longer converge
            take_back();
            note_errors_ahead();
            break;
        }
    }
    go_on_from_here();
    return true;
}

// Whether the rows of loops, or springs, can be softened further.
bool DirectSolve::may_soften() const
{
    const bool has_springs = std::ranges::any_of(m_axes, [](const Axis& axis) { return axis.law.spring.is_there(); });
    return (m_may_contradict && m_softening < most_softening) || (has_springs && m_spring_softening < most_softening);
}

// The impulse that closes an error is then bounded, however little the joints agree.
void DirectSolve::soften_to(double error)
{
    m_least_softening = std::max(m_least_softening, std::min(softening_of_error * error, 1.0));
    m_softening = std::max(m_softening, m_least_softening);
}

void DirectSolve::soften()
{
    m_softening = std::min(16 * m_softening, most_softening);
    m_spring_softening = std::min(16 * m_spring_softening, most_softening);
}

// Impacts, not loads: their impulses are no part of the warm start.
void DirectSolve::take_forbidden_speeds() { give_blow(Stage::Held); }

void DirectSolve::bounce() { give_blow(Stage::Now); }

void DirectSolve::give_blow(Stage stage)
{
    note_speeds();
    if (m_may_contradict)
        soften_to(largest_error());
    find_impulses(stage);
    take_velocities();
    report_as_blow();
}

// --- errors and speeds --------------------------------------------------------------------------------------------------------------

void DirectSolve::note_errors_ahead()
{
    place_ahead();
    turn_springs();
    for (const Item& item : m_items)
    {
        const JointWork& work = *item.work;
        const Placement a = ahead_of(item.a, work.a);
        const Placement b = ahead_of(item.b, work.b);
        const RowErrors errors = row_errors(*item.record, joint_pose(work, a, b));
        for (int r = 0; r < item.held; ++r)
            m_speeds[as_index(item.first_row + r)] = as_double(m_view.inverse_h) * as_double(errors[as_index(r)]);
        for (int r = item.held; r < item.rows(); ++r)
        {
            const float displacement = errors[as_index(r)] - item.row(r).error;
            m_speeds[as_index(item.first_row + r)] = as_double(m_view.inverse_h) * as_double(displacement);
        }
    }
}

void DirectSolve::place_ahead()
{
    for (std::size_t i = JointMatrix::ground + 1; i < m_nodes.size(); ++i)
        m_nodes[i].ahead = placed_ahead(m_view, m_nodes[i].state);
}

// Gives the impulses of springs the mean lines of the sub-step as the present velocities lead through it.
void DirectSolve::turn_springs()
{
    m_spring_change = 0;
    if (m_sprung_lines.empty())
        return;
    for (SprungLine& line : m_sprung_lines)
    {
        const Item& item = m_items[line.item];
        JointWork& work = m_joints[item.joint];
        AxisWork& own = work.axes[0];
        const double impulse = as_double(item.record->impulses[slot_of_axis(0, slot_spring)]);
        const Placement a = ahead_of(item.a, work.a);
        const Placement b = ahead_of(item.b, work.b);
        own.mean = mean_line(work.pose, joint_pose(work, a, b));
        own.has_mean = true;
        const JointRow& row = item.row(0);
        const Vec2 turned = own.mean.d - row.d;
        set_turn(line, impulse * as_triple(-turned, row.arm_a - own.mean.arm_a),
                 impulse * as_triple(turned, own.mean.arm_b - row.arm_b));
        m_spring_change =
            std::max(m_spring_change, std::fabs(m_impulses[as_index(item.first_row)]) * as_double(item.axis(0).inverse_mass));
    }
    place_ahead();
}

// In arms.
double DirectSolve::spring_change() const
{
    return m_longest_arm > 0 ? as_double(m_view.h) * m_spring_change / as_double(m_longest_arm) : 0;
}

// A slider's spring is none of them: its axis turns with a body. A body that turns by more than half a radian is not followed, and its spring damped.
void DirectSolve::find_sprung_lines()
{
    m_sprung_lines.clear();
    for (std::size_t i = 0; i < m_items.size(); ++i)
    {
        const Item& item = m_items[i];
        if (item.held > 0 || item.axes != 1 || item.row(0).is_angle)
            continue;
        AxisSpring& spring = m_joints[item.joint].axes[0].spring;
        if (!spring.acts_after())
            continue;
        const JointWork& work = *item.work;
        const auto turn = [this](std::int32_t state, Vec2 arm)
        { return arm == Vec2{} ? 0 : m_view.h * std::fabs(m_view.states[state].angular_velocity); };
        spring.theta = std::max(spring.theta, least_theta(2 * std::max(turn(work.a, work.ra0), turn(work.b, work.rb0))));
        m_sprung_lines.push_back({.item = i});
    }
}

void DirectSolve::straighten_springs()
{
    for (SprungLine& line : m_sprung_lines)
    {
        set_turn(line, {}, {});
        m_joints[m_items[line.item].joint].axes[0].has_mean = false;
    }
}

void DirectSolve::set_turn(SprungLine& line, const Triple& on_a, const Triple& on_b)
{
    const auto give = [this](int of, Triple& old, const Triple& now)
    {
        const Triple more = now - std::exchange(old, now);
        if (of != JointMatrix::ground)
            change_velocity(m_view.states[node(of).state], product(m_masses[as_index(of)], more));
    };
    const Item& item = m_items[line.item];
    give(item.a, line.on_a, on_a);
    give(item.b, line.on_b, on_b);
}

// All bodies of infinite mass share one node, but a kinematic body moves.
Placement DirectSolve::ahead_of(int node, std::int32_t state) const
{
    return node == JointMatrix::ground ? placed_ahead(m_view, state) : m_nodes[as_index(node)].ahead;
}

// In units of the longest arm, or rad.
double DirectSolve::largest_error() const
{
    double length = 0;
    double angle = 0;
    for (const Item& item : m_items)
    {
        const double* speed = &m_speeds[as_index(item.first_row)];
        for (int r = 0; r < item.rows(); ++r)
        {
            const double beyond =
                r < item.held ? std::fabs(speed[r])
                              : as_double(m_view.inverse_h) * item.axis(r).acts.comes_beyond(as_double(m_view.h) * speed[r]);
            double& largest = item.lines[r].is_angle ? angle : length;
            largest = std::max(largest, beyond);
        }
    }
    const double in_arms = m_longest_arm > 0 ? length / as_double(m_longest_arm) : 0;
    return as_double(m_view.h) * std::max(in_arms, angle);
}

// The widest gap, in arms, that was opened outside the solver and that it has not closed yet.
double DirectSolve::largest_gap() const
{
    double gap = 0;
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
        {
            if (item.row(r).is_angle)
                continue;
            const float open = std::min(std::fabs(item.work->moved[as_index(r)]), std::fabs(item.row(r).error));
            gap = std::max(gap, as_double(open));
        }
    }
    return m_longest_arm > 0 ? gap / as_double(m_longest_arm) : 0;
}

// The largest rotation that an axis gives its bodies in the sub-step, in rad. The error of held rows is then the square of it.
double DirectSolve::largest_turn() const
{
    double turn = 0;
    for (const Axis& axis : m_axes)
    {
        if (axis.joint_axis->row.is_angle)
            turn = std::max(turn, as_double(m_view.h) * std::fabs(change_along(axis)));
    }
    return turn;
}

void DirectSolve::note_speeds()
{
    for (std::size_t i = 0; i < m_items.size(); ++i)
    {
        const Item& item = m_items[i];
        const Triple a = velocity(m_view.states[item.work->a]);
        const Triple b = velocity(m_view.states[item.work->b]);
        for (int r = 0; r < item.rows(); ++r)
            m_speeds[as_index(item.first_row + r)] = dot(m_jacobians[i].a[r], a) + dot(m_jacobians[i].b[r], b);
    }
}

// The greatest speed at which a row that may contradict others closes. It is never less than the speed at which overlap is pushed out.
float DirectSolve::most_speed(const JointRow& row) const
{
    return m_view.push_speed + static_cast<float>(most_pull) * m_view.inverse_h * (row.is_angle ? 1 : m_longest_arm);
}

void DirectSolve::limit_speeds()
{
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
        {
            const double most = as_double(most_speed(item.row(r)));
            double& speed = m_speeds[as_index(item.first_row + r)];
            speed = std::clamp(speed, -most, most);
        }
    }
}

void DirectSolve::close_slowly()
{
    const double most = as_double(m_view.push_speed);
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            m_speeds[as_index(item.first_row + r)] += std::clamp(as_double(m_view.inverse_h * item.row(r).error), -most, most);
    }
}

// Stops push back no faster than held rows close.
AxisActs DirectSolve::acts_ahead(const JointAxis& axis, Stage stage) const
{
    AxisActs acts = axis.acts;
    if (stage == Stage::Ahead && !m_may_contradict)
        return acts;
    const float speed = stage == Stage::Soft ? m_view.push_speed : most_speed(axis.row);
    const float most = m_view.h * speed / way_back;
    acts.lower_error = std::max(acts.lower_error, -most);
    acts.upper_error = std::max(acts.upper_error, -most);
    return acts;
}

// --- closing gaps -------------------------------------------------------------------------------------------------------------------

void DirectSolve::close_gaps()
{
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            m_speeds[as_index(item.first_row + r)] = as_double(item.row(r).error);
    }
    find_impulses(Stage::Held);
    // A step that would turn a body far is taken only in part.
    double most = 0.5;
    for (const Node& n : m_nodes)
        most = std::max(most, std::fabs(n.change.turn));
    const double share = 0.5 / most;
    for (const Node& n : m_nodes)
    {
        if (n.state == none)
            continue;
        BodyState& s = m_view.states[n.state];
        s.delta_position += Vec2{static_cast<float>(share * n.change.x), static_cast<float>(share * n.change.y)};
        turn_by(s, static_cast<float>(share * n.change.turn));
    }
}

void DirectSolve::yield_to_gaps()
{
    if (m_ready && m_may_contradict && largest_gap() > most_gap)
        yield();
}

void close_gaps(DirectSolve& direct, const SolverView& view, SceneState& state, std::span<JointWork> joints)
{
    for (int i = 0; i < 4; ++i)
    {
        place_joints(view, state, joints);
        direct.prepare(view, state, joints, DirectSolve::Masses::Own);
        if (direct.is_ready())
            direct.close_gaps();
    }
    place_joints(view, state, joints);
    direct.yield_to_gaps();
}

} // namespace carom::internal
