// The joints of a small island, all at once. One row after the other they never agree: a double pendulum loses 6 % of its energy in a minute.
//
//   C_i = error of row i at the pose that the present velocities lead to
//   sum over j of J_i M^-1 J_j^T lambda_j = -C_i / h,  by Newton's method; in the relaxation J v = 0 at the pose reached
//
// With the drift along parabolas that is the RATTLE integrator, which neither gains nor loses energy. joint_matrix.cpp solves the equations.
//
// A free axis has a row too. Its law (joint_axis.h) is linear in pieces: along each the row keeps a rate, gives a known impulse, or has the compliance
// of a spring. All are solved with the pieces that they seem to be on, until each is on the one that its law has at the rate and impulse found: an
// active-set method. Springs, motors and stops so know the whole mechanism, at any stiffness and number of joints.
//
// A load that stretches a body between its joints makes it swing like a taut string, with omega² = f · r / I for the pull f at the arm r. A
// sub-step can follow that only while omega h is below 1. Beyond it, a body of a tree counts as harder to turn, just so far; the rows of a loop, which a taut
// chain stretches without bound, give way instead: their compliance grows with the third power of the stretch, because so falls the pull. It falls again
// by half a sub-step, lest the gap that it has left be closed at once.
//
// Joints of a loop may contradict each other, and so may those of a body that is locked along a line. The compliance bounds what they then bear, if the
// error that they act on is bounded: a pull that is wide beside the arms turns bodies to where it is another one.
//
// No impulse is right where a wall holds a body that joints pull: joints and contacts would outbid each other without end. The joints then yield, as they do
// where they stay far apart. They are as soft as their bodies are heavy, for which the turns of joints and contacts converge to one small pull, and what has
// opened closes slowly.

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

constexpr float most_stretch = 1;  // (omega h)²
constexpr double most_gap = 0.01;  // in arms: wider ones that others have made are closed by moving bodies, without speed
constexpr double most_pull = 0.25; // in arms, or rad: rows that may contradict each other act as if they were off by no more
constexpr double most_contradiction = 0.5; // likewise: where they are off by more and stay so, they yield
constexpr int newton_steps = 2;
constexpr int most_newton_steps = 6;
constexpr double converged = 1e-6; // in arms, or rad: rows that loops hold twice share out what is left
constexpr int rounds_of_all = 8;   // of the active set; then axes change one at a time, which ends
constexpr int most_rounds = 64;
constexpr double loop_compliance = 1e-3;  // of a row's weight
constexpr double yielding_compliance = 1; // likewise
constexpr double most_softening = 400;
constexpr double same_rate = 1e-6;
constexpr double least_share = 1e-3; // of a spring's compliance, where its row is softer than the spring

Triple velocity(const BodyState& s) { return as_triple(s.velocity, s.angular_velocity); }

// 0 and -0 differ.
bool is_same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

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
        m_fits = find_edges() && !m_edges.empty();
    m_ready = m_fits;
    if (m_ready && place())
    {
        m_matrix.fill(m_jacobians, m_masses);
        m_factored_with = -1;
    }
    if (m_ready && m_may_contradict)
        m_softening = std::clamp(std::max(m_softening, 0.5 * present_compliance() / loop_compliance), 1.0, most_softening);
}

// --- who is connected with whom -----------------------------------------------------------------------------------------------------

// It keeps through the step, but where a body takes off or lands.
bool DirectSolve::find_edges()
{
    m_found.clear();
    int rows = 0;
    for (std::size_t i = 0; i < m_joints.size(); ++i)
    {
        const JointWork& work = m_joints[i];
        const int held = work.rows.held_count;
        const bool has_axis = work.rows.has_axis();
        if ((held == 0 && !has_axis) || is_in_flight(m_view, work))
            continue;
        rows += held + (has_axis ? 1 : 0);
        if (rows > m_most_rows)
            return false;
        m_found.push_back({i, moving(work.a), moving(work.b), held, has_axis});
    }
    if (m_found != m_edges)
        lay_out();
    return true;
}

void DirectSolve::lay_out()
{
    m_edges = m_found;
    m_is_new = true;
    std::vector<std::int32_t> states{none}; // the ground
    for (const Edge& e : m_edges)
        states.insert(states.end(), {e.a, e.b});
    std::ranges::sort(states);
    states.erase(std::ranges::unique(states).begin(), states.end());
    m_nodes.clear();
    for (const std::int32_t state : states)
        m_nodes.push_back({.state = state});
    m_masses.assign(m_nodes.size(), {});

    std::vector<JointMatrix::Edge> edges;
    for (const Edge& e : m_edges)
        edges.push_back({node_of(e.a), node_of(e.b), e.held + (e.has_axis ? 1 : 0)});
    m_matrix.lay_out(edges, static_cast<int>(m_nodes.size()));
    m_items.clear();
    for (std::size_t i = 0; i < m_edges.size(); ++i)
    {
        Item& item = m_items.emplace_back();
        item.joint = m_edges[i].joint;
        item.held = m_edges[i].held;
        item.first_row = m_matrix.first_row(i);
        item.a = edges[i].a;
        item.b = edges[i].b;
    }
    find_articulations();
    m_jacobians.assign(m_items.size(), {});
    for (std::vector<double>* values : {&m_compliances, &m_wanted_compliances, &m_speeds, &m_impulses})
        values->assign(as_index(m_matrix.rows()), 0);
}

std::int32_t DirectSolve::moving(std::int32_t state) const
{
    return (m_view.states[state].flags & body_flag::dynamic) != 0 ? state : none;
}

int DirectSolve::node_of(std::int32_t state) const
{
    return static_cast<int>(std::ranges::lower_bound(m_nodes, state, {}, &Node::state) - m_nodes.begin());
}

// --- where they are -----------------------------------------------------------------------------------------------------------------

// False where nothing has changed: a sub-step often begins as the last one has ended.
bool DirectSolve::place()
{
    for (Node& n : m_nodes)
        n.stretch = 0;
    bool changed = std::exchange(m_is_new, false);
    m_may_contradict = m_matrix.has_loops() || std::ranges::any_of(m_nodes, [&](const Node& n) { return is_locked(n); });
    float longest = 0;
    for (std::size_t i = 0; i < m_items.size(); ++i)
    {
        Item& item = m_items[i];
        item.work = &m_joints[item.joint];
        item.record = &m_state->joints[item.work->joint];
        const JointPose& pose = item.work->pose;
        longest = std::max({longest, dot(pose.ra, pose.ra), dot(pose.rb, pose.rb), dot(pose.gap, pose.gap)});
        note_stretch(item);
        if (item.take_lines())
        {
            fill_jacobian(item, m_jacobians[i]);
            changed = true;
        }
    }
    m_longest_arm = std::sqrt(longest);
    find_anchors();
    double stretch = 1;
    for (std::size_t i = JointMatrix::ground + 1; i < m_nodes.size(); ++i)
        stretch = std::max(stretch, as_double(m_nodes[i].stretch));
    m_softening = stretch * stretch * stretch;
    for (std::size_t i = JointMatrix::ground + 1; i < m_nodes.size(); ++i)
    {
        const Triple old = std::exchange(m_masses[i], inverse_mass(m_nodes[i]));
        changed |= m_masses[i] != old;
    }
    return changed;
}

// How far the rows have given way, per impulse that they bear.
double DirectSolve::present_compliance() const
{
    double rate = 0;
    double impulse = 0;
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
        {
            const double weight = m_matrix.weight(item.first_row + r);
            rate = std::max(rate, weight > 0 ? std::fabs(as_double(m_view.inverse_h * item.row(r).error)) / weight : 0);
            impulse = std::max(impulse, std::fabs(as_double(item.impulse(r))));
        }
    }
    return impulse > 0 ? rate / impulse : 0;
}

// True where they are others than before, to the last bit.
bool DirectSolve::Item::take_lines()
{
    bool changed = false;
    for (int r = 0; r < rows(); ++r)
    {
        const JointRow& now = row(r);
        Line& line = lines[r];
        changed |= !is_same(now.d.x, line.d.x) || !is_same(now.d.y, line.d.y) || !is_same(now.arm_a, line.arm_a) ||
                   !is_same(now.arm_b, line.arm_b);
        line = {now.d, now.arm_a, now.arm_b};
    }
    return changed;
}

void DirectSolve::fill_jacobian(const Item& item, JointJacobian& jacobian) const
{
    for (int r = 0; r < item.rows(); ++r)
    {
        const Line& line = item.lines[r];
        jacobian.a[r] = as_triple(-line.d, -line.arm_a);
        jacobian.b[r] = as_triple(line.d, line.arm_b);
    }
    const JointPose& pose = item.work->pose;
    jacobian.arm_a = as_double(dot(pose.ra, pose.ra));
    jacobian.arm_b = as_double(dot(pose.rb, pose.rb));
}

void DirectSolve::note_stretch(const Item& item)
{
    const JointWork& work = *item.work;
    Vec2 pull{}; // on b, over a sub-step
    for (const JointRow& row : work.rows.holds())
        pull += item.record->impulses[row.slot] * row.d;
    if (work.rows.has_axis())
        pull += axis_impulse(*item.record) * work.rows.axis.d;
    node(item.a).stretch -= m_view.h * m_view.constants[work.a].inverse_inertia * dot(pull, work.pose.ra);
    node(item.b).stretch += m_view.h * m_view.constants[work.b].inverse_inertia * dot(pull, work.pose.rb);
}

// True where the body cannot move along x or along y.
bool DirectSolve::is_locked(const Node& node) const
{
    return node.state != none &&
           (m_view.constants[node.state].inverse_mass.x == 0 || m_view.constants[node.state].inverse_mass.y == 0);
}

Triple DirectSolve::inverse_mass(const Node& node) const
{
    const StateConstants& c = m_view.constants[node.state];
    const bool counts_as_harder =
        m_mass_kind == Masses::Loaded && !m_may_contradict && node.stretch > most_stretch; // loops give way instead
    const float share = counts_as_harder ? most_stretch / node.stretch : 1;
    return as_triple(c.inverse_mass, share * c.inverse_inertia);
}

// No oscillation of a chain is faster than the two bodies of its stiffest joint would swing against fixed neighbours.
void DirectSolve::fit_springs()
{
    if (!m_ready)
        return;
    for (Node& n : m_nodes)
    {
        n.sprung = 0;
        n.springs = 0;
    }
    for (const Item& item : m_items)
    {
        if (!item.is_sprung())
            continue;
        const JointRow& axis = item.work->rows.axis;
        const float stiffness = item.work->spring.stiffness;
        add_spring(node(item.a), stiffness, axis.d, axis.arm_a);
        add_spring(node(item.b), stiffness, axis.d, axis.arm_b);
    }
    for (const Item& item : m_items)
    {
        if (!item.is_sprung())
            continue;
        JointWork& work = m_joints[item.joint];
        const Node& a = node(item.a);
        const Node& b = node(item.b);
        const float alone = work.spring.stiffness * work.rows.axis_inverse_mass;
        const float rate = a.springs > 1 || b.springs > 1 ? std::max(alone, a.sprung + b.sprung) : alone;
        work.spring.theta = std::max(work.spring.theta, least_theta(m_view.h * std::sqrt(rate)));
    }
}

void DirectSolve::add_spring(Node& node, float stiffness, Vec2 d, float arm) const
{
    if (node.state == none)
        return;
    const StateConstants& c = m_view.constants[node.state];
    node.sprung += stiffness * (c.inverse_mass.x * d.x * d.x + c.inverse_mass.y * d.y * d.y + c.inverse_inertia * arm * arm);
    ++node.springs;
}

// --- the passes ---------------------------------------------------------------------------------------------------------------------

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
    note_speeds();
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

// Newton's steps lead nowhere where a sub-step turns a body so far that no straight way ends in the right place.
bool DirectSolve::find_pose_ahead()
{
    note_errors_ahead();
    if (largest_error() > 1)
    { // what held in the sub-step before leads astray now
        start_anew();
        note_errors_ahead();
    }
    const double before = largest_error();
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
        m_turns_too_far = after > 0.5 * std::max(before, turn) && after > 1e-3;
        const bool contradicts = m_may_contradict && after > most_contradiction;
        if (!m_turns_too_far || (m_may_contradict && !contradicts && !may_soften()))
            break;
        take_back();
        if (!may_soften())
        {
            if (m_spring_softening > 1 || contradicts) // nor may what springs gave before go on
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
    for (int i = 1; i < newton_steps || (i < most_newton_steps && left > converged); ++i)
    {
        take_step(Stage::Ahead);
        note_errors_ahead();
        const double before_this = std::exchange(left, largest_error());
        if (i >= newton_steps && left > 0.5 * before_this)
        { // they lead nowhere from here on
            take_back();
            note_errors_ahead();
            break;
        }
    }
    go_on_from_here();
    return true;
}

// Rows of loops give way, and springs.
bool DirectSolve::may_soften() const
{
    const bool has_springs = std::ranges::any_of(m_axes, [](const Axis& axis) { return axis.law.spring.is_there(); });
    return (m_may_contradict && m_softening < most_softening) || (has_springs && m_spring_softening < most_softening);
}

void DirectSolve::soften()
{
    m_softening = std::min(16 * m_softening, most_softening);
    m_spring_softening = std::min(16 * m_spring_softening, most_softening);
}

// Blows, not loads: they are no part of what the rows are warm started with.
void DirectSolve::take_forbidden_speeds() { give_blow(Stage::Held); }

void DirectSolve::bounce() { give_blow(Stage::Now); }

void DirectSolve::give_blow(Stage stage)
{
    note_speeds();
    find_impulses(stage);
    take_velocities();
    report_as_blow();
}

// --- errors and speeds --------------------------------------------------------------------------------------------------------------

void DirectSolve::note_errors_ahead()
{
    for (std::size_t i = JointMatrix::ground + 1; i < m_nodes.size(); ++i)
        m_nodes[i].ahead = placed_ahead(m_view, m_nodes[i].state);
    for (const Item& item : m_items)
    {
        const JointWork& work = *item.work;
        const Placement a = ahead_of(item.a, work.a);
        const Placement b = ahead_of(item.b, work.b);
        const Vec2 error = held_error(*item.record, work, a, b);
        for (int r = 0; r < item.held; ++r)
            m_speeds[as_index(item.first_row + r)] = as_double(m_view.inverse_h) * as_double(r == 0 ? error.x : error.y);
        if (work.rows.has_axis())
        {
            const float way = axis_coordinate(*item.record, joint_pose(work, a, b)) - axis_coordinate(*item.record, work.pose);
            m_speeds[as_index(item.first_row + item.held)] = as_double(m_view.inverse_h) * as_double(way);
        }
    }
}

// All that does not move is one node; but a kinematic body has a way.
Placement DirectSolve::ahead_of(int node, std::int32_t state) const
{
    return node == JointMatrix::ground ? placed_ahead(m_view, state) : m_nodes[as_index(node)].ahead;
}

// In islands of the longest arm, or rad.
double DirectSolve::largest_error() const
{
    double length = 0;
    double angle = 0;
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
        {
            double& largest = item.row(r).slot == slot_lock ? angle : length;
            largest = std::max(largest, std::fabs(m_speeds[as_index(item.first_row + r)]));
        }
        if (item.work->rows.has_axis())
        {
            double& largest = item.row(item.held).d == Vec2{} ? angle : length;
            const double way = as_double(m_view.h) * m_speeds[as_index(item.first_row + item.held)];
            largest = std::max(largest, as_double(m_view.inverse_h) * item.work->rows.acts.comes_beyond(way));
        }
    }
    const double in_arms = m_longest_arm > 0 ? length / as_double(m_longest_arm) : 0;
    return as_double(m_view.h) * std::max(in_arms, angle);
}

// The widest gap, in arms, that others than the solver have opened and it has not closed yet.
double DirectSolve::largest_gap() const
{
    double gap = 0;
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
        {
            if (item.row(r).slot == slot_lock)
                continue;
            const float open = std::min(std::fabs(item.work->moved[as_index(r)]), std::fabs(item.row(r).error));
            gap = std::max(gap, as_double(open));
        }
    }
    return m_longest_arm > 0 ? gap / as_double(m_longest_arm) : 0;
}

// The largest turn that an axis gives its bodies in the sub-step, in rad: held rows then err by the square of it.
double DirectSolve::largest_turn() const
{
    double turn = 0;
    for (const Axis& axis : m_axes)
    {
        const Item& item = m_items[axis.item];
        if (item.work->rows.axis.d == Vec2{})
            turn = std::max(turn, as_double(m_view.h) * std::fabs(change_along(item, item.held)));
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

// The greatest speed at which a row that may contradict others closes; in no case less than that of pushing out.
float DirectSolve::most_speed(const JointRow& row) const
{
    return m_view.push_speed + static_cast<float>(most_pull) * m_view.inverse_h * (row.d == Vec2{} ? 1 : m_longest_arm);
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
AxisActs DirectSolve::acts_ahead(const JointRows& rows, Stage stage) const
{
    AxisActs acts = rows.acts;
    if (stage == Stage::Ahead && !m_may_contradict)
        return acts;
    const float speed = stage == Stage::Soft ? m_view.push_speed : most_speed(rows.axis);
    const float most = m_view.h * speed / way_back;
    acts.lower_error = std::max(acts.lower_error, -most);
    acts.upper_error = std::max(acts.upper_error, -most);
    return acts;
}

// --- impulses -----------------------------------------------------------------------------------------------------------------------

void DirectSolve::find_impulses(Stage stage)
{
    begin_axes(stage);
    for (int round = 0;; ++round)
    {
        solve_pieces();
        if (!take_next_pieces(round < rounds_of_all))
            return;
        if (round == most_rounds)
            break;
    }
    give_up_on_pieces();
    solve_pieces();
}

void DirectSolve::begin_axes(Stage stage)
{
    m_compliance = !m_may_contradict ? 0 : stage == Stage::Ahead ? loop_compliance * m_softening : loop_compliance;
    m_leak = stage == Stage::Ahead ? m_compliance : 0;
    if (m_yields && stage != Stage::Held)
        m_compliance = m_leak = std::max(m_compliance, yielding_compliance);
    m_axes.clear();
    for (std::size_t i = 0; i < m_items.size(); ++i)
    {
        const Item& item = m_items[i];
        const JointRows& rows = item.work->rows;
        if (!rows.has_axis())
            continue;
        Axis& axis = m_axes.emplace_back();
        axis.item = i;
        axis.row = item.first_row + item.held;
        axis.restore = axis_impulses(*item.record);
        if (stage == Stage::Held)
            continue;
        if (stage == Stage::Now)
            axis.law = rows.acts.law_now(axis.restore, item.work->bounce, m_view.h);
        else
            axis.law = acts_ahead(rows, stage).law_ahead(item.work->spring, m_view.h);
        for (SpringLine* spring : {&axis.law.spring, &axis.law.soft_lower, &axis.law.soft_upper})
        { // the softness of the row is part of a spring's own
            const double own = m_spring_softening * spring->compliance;
            spring->compliance = std::max(own - softness(axis), least_share * own);
        }
        axis.before = axis.law.scope.sum(axis.restore);
        const double k = as_double(rows.axis_inverse_mass);
        axis.piece = axis.law.solve(m_speeds[as_index(axis.row)] + (softness(axis) - k) * axis.before, k);
    }
}

// With every axis on its piece.
void DirectSolve::solve_pieces()
{
    std::ranges::fill(m_wanted_compliances, 0);
    for (const Axis& axis : m_axes)
    {
        if (!axis.piece.keeps_rate())
            m_wanted_compliances[as_index(axis.row)] =
                axis.piece.spring.is_there() ? axis.piece.spring.compliance : JointMatrix::off;
    }
    if (m_factored_with != m_compliance || m_wanted_compliances != m_compliances)
    {
        m_compliances.swap(m_wanted_compliances);
        m_matrix.factor(m_compliances, m_compliance);
        m_factored_with = m_compliance;
    }
    give_known_impulses();
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
        {
            const int row = item.first_row + r;
            m_impulses[as_index(row)] =
                -(m_speeds[as_index(row)] + change_along(item, r)) - m_leak * m_matrix.weight(row) * as_double(item.impulse(r));
        }
    }
    for (const Axis& axis : m_axes)
    {
        const Item& item = m_items[axis.item];
        const double speed = m_speeds[as_index(axis.row)] + change_along(item, item.held);
        const double leak = softness(axis) * axis.before;
        double& wanted = m_impulses[as_index(axis.row)];
        const SpringLine& spring = axis.piece.spring;
        if (axis.piece.keeps_rate())
            wanted = axis.piece.rate - speed - leak;
        else if (spring.is_there())
            wanted = spring.rest - speed - leak - spring.compliance * (axis.before - axis.piece.constant);
        else
            wanted = 0;
    }
    m_matrix.solve(m_impulses);
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            push(item, r, m_impulses[as_index(item.first_row + r)]);
    }
    for (const Axis& axis : m_axes)
    {
        const Item& item = m_items[axis.item];
        if (m_compliances[as_index(axis.row)] == JointMatrix::off)
            m_impulses[as_index(axis.row)] = axis.piece.constant - axis.before;
        else
            push(item, item.held, m_impulses[as_index(axis.row)]);
    }
}

// Of axes that do not depend on the rate.
void DirectSolve::give_known_impulses()
{
    for (Node& n : m_nodes)
        n.change = {};
    for (const Axis& axis : m_axes)
    {
        if (m_compliances[as_index(axis.row)] == JointMatrix::off)
            push(m_items[axis.item], m_items[axis.item].held, axis.piece.constant - axis.before);
    }
}

// The rate at which an axis' law gives its impulse: the row itself gives way in proportion to that impulse.
double DirectSolve::rate_of_law(const Axis& axis) const
{
    const Item& item = m_items[axis.item];
    const double given_way =
        m_matrix.weight(axis.row) * m_compliance * m_impulses[as_index(axis.row)] + softness(axis) * axis.before;
    return m_speeds[as_index(axis.row)] + change_along(item, item.held) + given_way;
}

// False where all are where they should be.
bool DirectSolve::take_next_pieces(bool all)
{
    bool changed = false;
    for (Axis& axis : m_axes)
    {
        const Item& item = m_items[axis.item];
        const double k = as_double(item.work->rows.axis_inverse_mass);
        const double impulse = m_impulses[as_index(axis.row)];
        const double rate = rate_of_law(axis);
        const AxisPiece next = axis.law.solve(rate - k * (axis.before + impulse), k);
        if (std::fabs(next.rate - rate) <= same_rate * std::max(1.0, std::fabs(rate)))
            continue;
        axis.piece = axis.law.neighbour(axis.piece, next);
        changed = true;
        if (!all)
            return true;
    }
    return changed;
}

// Each goes on giving what it gives: nothing comes from that but what held rows take.
void DirectSolve::give_up_on_pieces()
{
    for (Axis& axis : m_axes)
    {
        axis.law.scope = {};
        axis.piece = {};
        axis.piece.constant = axis.before;
    }
}

void DirectSolve::push(const Item& item, int row, double impulse)
{
    const JointJacobian& j = m_jacobians[static_cast<std::size_t>(&item - m_items.data())];
    if (item.a != JointMatrix::ground)
        node(item.a).change += impulse * product(m_masses[as_index(item.a)], j.a[row]);
    if (item.b != JointMatrix::ground)
        node(item.b).change += impulse * product(m_masses[as_index(item.b)], j.b[row]);
}

double DirectSolve::change_along(const Item& item, int row) const
{
    const JointJacobian& j = m_jacobians[static_cast<std::size_t>(&item - m_items.data())];
    return dot(j.a[row], node(item.a).change) + dot(j.b[row], node(item.b).change);
}

void DirectSolve::take_velocities(double sign)
{
    for (const Node& n : m_nodes)
    {
        if (n.state == none)
            continue;
        change_velocity(m_view.states[n.state], sign * n.change);
    }
}

void DirectSolve::take_impulses()
{
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            item.impulse(r) += static_cast<float>(m_impulses[as_index(item.first_row + r)]);
    }
    for (const Axis& axis : m_axes)
    {
        const Item& item = m_items[axis.item];
        const double rate = rate_of_law(axis);
        const AxisImpulses now = axis.law.split(axis.piece, axis.before + m_impulses[as_index(axis.row)], rate);
        set_axis_impulses(*item.record, axis.law.scope.merge(axis.restore, now));
    }
}

void DirectSolve::take_back()
{
    take_velocities(-1);
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            item.impulse(r) -= static_cast<float>(m_impulses[as_index(item.first_row + r)]);
    }
    for (const Axis& axis : m_axes)
        set_axis_impulses(*m_items[axis.item].record, axis.restore);
}

// The speeds are noted: what has been given up to here is in them.
void DirectSolve::go_on_from_here()
{
    for (Node& n : m_nodes)
        n.change = {};
    std::ranges::fill(m_impulses, 0.0);
    for (Axis& axis : m_axes)
    {
        axis.restore = axis_impulses(*m_items[axis.item].record);
        axis.before = axis.law.scope.sum(axis.restore);
    }
}

void DirectSolve::report_as_blow()
{
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.rows(); ++r)
            m_joints[item.joint].add(item.row(r), static_cast<float>(m_impulses[as_index(item.first_row + r)]));
    }
}

void DirectSolve::warm_start()
{
    for (Node& n : m_nodes)
        n.change = {};
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            push(item, r, as_double(item.impulse(r)));
        if (item.work->rows.has_axis())
            push(item, item.held, as_double(axis_impulse(*item.record)));
    }
    take_velocities();
}

void DirectSolve::start_anew()
{
    for (Node& n : m_nodes)
        n.change = {};
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            push(item, r, -as_double(std::exchange(item.impulse(r), 0.0f)));
        if (item.work->rows.has_axis())
        {
            push(item, item.held, -as_double(axis_impulse(*item.record)));
            set_axis_impulses(*item.record, {});
        }
    }
    take_velocities();
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
    // A step that would turn a body far is taken in part.
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
