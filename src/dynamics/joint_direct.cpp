// What the joints of a small unit hold, all at once. One row after the other they never agree: a double pendulum loses 6 % of its energy in
// a minute.
//
//   C_i = error of row i at the pose that the present velocities lead to
//   sum over j of J_i M^-1 J_j^T lambda_j = -C_i / h,  two Newton passes; in the relaxation J v = 0 at the pose reached
//
// With the drift along parabolas that is the RATTLE integrator, which neither gains nor loses energy. The joints are ordered into a forest
// (joint_forest.h), which makes the system short work (joint_matrix.cpp). Loops would make it singular: soft rows take those.
//
// A load that stretches a body between its joints makes it swing like a taut string, with omega² = f · r / I for the pull f at the arm r. A
// sub-step can follow that only while omega h is below 1: beyond it the body counts as harder to turn, just so far.

#include "dynamics/joint_direct.h"

#include "dynamics/scene_data.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace carom::internal {

namespace {

constexpr float most_stretch = 1; // (omega h)²

double as_double(float x) { return static_cast<double>(x); }

Triple as_triple(Vec2 v, float turn) { return {as_double(v.x), as_double(v.y), as_double(turn)}; }

Triple velocity(const BodyState& s) { return as_triple(s.velocity, s.angular_velocity); }

// J^T impulse, of the rows at one body.
Triple momentum(const Triple (&rows)[2], const RowPair& impulse)
{
    return {rows[0].x * impulse.x + rows[1].x * impulse.y, rows[0].y * impulse.x + rows[1].y * impulse.y,
            rows[0].turn * impulse.x + rows[1].turn * impulse.y};
}

// 0 and -0 differ.
bool is_same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

} // namespace

void DirectSolve::prepare(const SolverView& view, SceneState& state, std::span<JointWork> joints)
{
    m_view = view;
    m_state = &state;
    m_joints = joints;
    m_turns_too_far = false;
    if (std::exchange(m_looks_again, false))
        m_is_forest = find_forest() && !m_links.empty();
    m_ready = m_is_forest;
    if (!m_ready)
        return;
    if (place())
        m_is_regular = m_matrix.factor(m_forest.joints(), m_jacobians, m_masses);
    m_ready = m_is_regular;
}

// --- who hangs on whom --------------------------------------------------------------------------------------------------------------

// It keeps through the step, but where a body takes off or lands.
bool DirectSolve::find_forest()
{
    m_found.clear();
    int rows = 0;
    for (std::size_t i = 0; i < m_joints.size(); ++i)
    {
        const JointWork& work = m_joints[i];
        const int held = work.rows.held_count;
        if (held == 0 || is_in_flight(m_view, work))
            continue;
        rows += held;
        if (rows > most_rows)
            return false;
        m_found.push_back({static_cast<int>(i), held, moving(work.a), moving(work.b)});
    }
    if (m_found != m_links)
        lay_out();
    return !m_has_loops;
}

void DirectSolve::lay_out()
{
    m_links = m_found;
    m_has_loops = !m_forest.build(m_links);
    if (m_has_loops)
        return;
    m_is_new = true;
    m_matrix.lay_out(m_forest.joints());
    m_nodes.clear();
    for (const std::int32_t state : m_forest.bodies())
        m_nodes.push_back({.state = state});
    m_masses.assign(m_nodes.size(), {});
    m_held.clear();
    m_jacobians.clear();
    for (const JointForest::Joint& joint : m_forest.joints())
    {
        const JointForest::Link& link = m_links[static_cast<std::size_t>(joint.link)];
        const bool a_is_up = node(joint.up).state == link.a;
        Held& held = m_held.emplace_back();
        held.joint = static_cast<std::size_t>(link.joint);
        held.rows = link.rows;
        held.up = joint.up;
        held.down = joint.down;
        held.a = a_is_up ? joint.up : joint.down;
        held.b = a_is_up ? joint.down : joint.up;
        m_jacobians.push_back({{}, {}, link.rows});
    }
    m_residual.resize(m_held.size());
    m_impulse.resize(m_held.size());
}

std::int32_t DirectSolve::moving(std::int32_t state) const
{
    return (m_view.states[state].flags & body_flag::dynamic) != 0 ? state : none;
}

// --- where they are -----------------------------------------------------------------------------------------------------------------

// False where nothing has changed: a sub-step often begins as the last one has ended.
bool DirectSolve::place()
{
    for (Node& n : m_nodes)
        n.stretch = 0;
    bool changed = std::exchange(m_is_new, false);
    float longest = 0;
    for (std::size_t i = 0; i < m_held.size(); ++i)
    {
        Held& held = m_held[i];
        held.work = &m_joints[held.joint];
        held.record = &m_state->joints[held.work->joint];
        const JointPose& pose = held.work->pose;
        longest = std::max({longest, dot(pose.ra, pose.ra), dot(pose.rb, pose.rb), dot(pose.gap, pose.gap)});
        note_stretch(held);
        if (held.take_lines())
        {
            fill_jacobian(held, m_jacobians[i]);
            changed = true;
        }
    }
    m_longest_arm = std::sqrt(longest);
    for (std::size_t i = JointForest::ground + 1; i < m_nodes.size(); ++i)
    {
        const Triple old = std::exchange(m_masses[i], inverse_mass(m_nodes[i]));
        changed |= m_masses[i] != old;
    }
    return changed;
}

// True where they are others than before, to the last bit.
bool DirectSolve::Held::take_lines()
{
    bool changed = false;
    for (int r = 0; r < rows; ++r)
    {
        const JointRow& row = work->rows.held[r];
        Line& line = lines[r];
        changed |= !is_same(row.d.x, line.d.x) || !is_same(row.d.y, line.d.y) || !is_same(row.arm_a, line.arm_a) ||
                   !is_same(row.arm_b, line.arm_b);
        line = {row.d, row.arm_a, row.arm_b};
    }
    return changed;
}

void DirectSolve::fill_jacobian(const Held& held, JointJacobian& jacobian) const
{
    Triple(&at_a)[2] = held.a == held.up ? jacobian.up : jacobian.down;
    Triple(&at_b)[2] = held.a == held.up ? jacobian.down : jacobian.up;
    for (int r = 0; r < held.rows; ++r)
    {
        const Line& line = held.lines[r];
        at_a[r] = as_triple(-line.d, -line.arm_a);
        at_b[r] = as_triple(line.d, line.arm_b);
    }
}

void DirectSolve::note_stretch(const Held& held)
{
    const JointWork& work = *held.work;
    Vec2 pull{}; // on b, over a sub-step
    for (const JointRow& row : work.rows.holds())
        pull += held.record->impulses[row.slot] * row.d;
    node(held.a).stretch -= m_view.h * m_view.constants[work.a].inverse_inertia * dot(pull, work.pose.ra);
    node(held.b).stretch += m_view.h * m_view.constants[work.b].inverse_inertia * dot(pull, work.pose.rb);
}

Triple DirectSolve::inverse_mass(const Node& node) const
{
    const StateConstants& c = m_view.constants[node.state];
    const float share = node.stretch > most_stretch ? most_stretch / node.stretch : 1;
    return as_triple(c.inverse_mass, share * c.inverse_inertia);
}

// --- the passes ---------------------------------------------------------------------------------------------------------------------

void DirectSolve::solve(bool use_bias)
{
    if (!use_bias || !find_pose_ahead())
        keep_together();
}

void DirectSolve::keep_together()
{
    note_speeds();
    find_impulses();
    apply();
}

// A blow, not a load: it is no part of what the rows are warm started with.
void DirectSolve::take_forbidden_speeds()
{
    note_speeds();
    find_impulses();
    for (std::size_t i = 0; i < m_held.size(); ++i)
    {
        push(i, m_impulse[i]);
        m_held[i].note_blow(m_joints[m_held[i].joint], m_impulse[i]);
    }
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
    m_turns_too_far = before > 1;
    if (m_turns_too_far)
        return false;
    find_impulses();
    apply();
    note_errors_ahead();
    const double after = largest_error();
    m_turns_too_far = after > 0.5 * before && after > 1e-3;
    if (m_turns_too_far)
    {
        apply(-1); // taken back
        return false;
    }
    find_impulses();
    apply();
    return true;
}

// --- errors, speeds, impulses -------------------------------------------------------------------------------------------------------

void DirectSolve::note_errors_ahead()
{
    for (std::size_t i = JointForest::ground + 1; i < m_nodes.size(); ++i)
        m_nodes[i].ahead = placed_ahead(m_view, m_nodes[i].state);
    for (std::size_t i = 0; i < m_held.size(); ++i)
    {
        const Held& held = m_held[i];
        const Vec2 error = held_error(*held.record, *held.work, ahead_of(held.a, held.work->a), ahead_of(held.b, held.work->b));
        m_residual[i] = {as_double(m_view.inverse_h) * as_double(error.x), as_double(m_view.inverse_h) * as_double(error.y)};
    }
}

// Of all that does not move there is one node; but what is kinematic has a way.
Placement DirectSolve::ahead_of(int node, std::int32_t state) const
{
    return node == JointForest::ground ? placed_ahead(m_view, state) : m_nodes[static_cast<std::size_t>(node)].ahead;
}

// In units of the longest arm, or rad.
double DirectSolve::largest_error() const
{
    double length = 0;
    double angle = 0;
    for (std::size_t i = 0; i < m_held.size(); ++i)
    {
        length = std::max(length, std::fabs(m_residual[i].x));
        double& second = m_held[i].work->rows.held[1].slot == slot_lock ? angle : length;
        second = std::max(second, std::fabs(m_residual[i].y));
    }
    const double in_arms = length > 0 ? length / as_double(m_longest_arm) : 0;
    return as_double(m_view.h) * std::max(in_arms, angle);
}

void DirectSolve::note_speeds()
{
    for (std::size_t i = 0; i < m_held.size(); ++i)
    {
        const JointJacobian& j = m_jacobians[i];
        const Held& held = m_held[i];
        const Triple up = velocity(m_view.states[held.a == held.up ? held.work->a : held.work->b]);
        const Triple down = velocity(m_view.states[held.a == held.up ? held.work->b : held.work->a]);
        m_residual[i] = {dot(j.up[0], up) + dot(j.down[0], down), dot(j.up[1], up) + dot(j.down[1], down)};
    }
}

void DirectSolve::find_impulses()
{
    for (std::size_t i = 0; i < m_residual.size(); ++i)
        m_impulse[i] = {-m_residual[i].x, -m_residual[i].y};
    m_matrix.solve(m_impulse);
}

void DirectSolve::apply(double sign)
{
    for (std::size_t i = 0; i < m_held.size(); ++i)
    {
        const RowPair impulse = {sign * m_impulse[i].x, sign * m_impulse[i].y};
        push(i, impulse);
        m_held[i].add(impulse);
    }
}

void DirectSolve::warm_start()
{
    for (std::size_t i = 0; i < m_held.size(); ++i)
        push(i, m_held[i].impulses());
}

void DirectSolve::start_anew()
{
    for (std::size_t i = 0; i < m_held.size(); ++i)
    {
        const RowPair old = m_held[i].impulses();
        push(i, {-old.x, -old.y});
        m_held[i].add({-old.x, -old.y});
    }
}

float& DirectSolve::Held::impulse(int row) const { return record->impulses[work->rows.held[row].slot]; }

RowPair DirectSolve::Held::impulses() const { return {as_double(impulse(0)), rows == 2 ? as_double(impulse(1)) : 0}; }

void DirectSolve::Held::add(const RowPair& change) const
{
    impulse(0) += static_cast<float>(change.x);
    if (rows == 2)
        impulse(1) += static_cast<float>(change.y);
}

void DirectSolve::Held::note_blow(JointWork& told, const RowPair& impulse) const
{
    told.add(work->rows.held[0], static_cast<float>(impulse.x));
    if (rows == 2)
        told.add(work->rows.held[1], static_cast<float>(impulse.y));
}

void DirectSolve::push(std::size_t joint, const RowPair& impulse)
{
    push(m_held[joint].up, momentum(m_jacobians[joint].up, impulse));
    push(m_held[joint].down, momentum(m_jacobians[joint].down, impulse));
}

void DirectSolve::push(int body, const Triple& momentum)
{
    if (body == JointForest::ground)
        return;
    const Triple change = product(m_masses[static_cast<std::size_t>(body)], momentum);
    BodyState& s = m_view.states[node(body).state];
    s.velocity += Vec2{static_cast<float>(change.x), static_cast<float>(change.y)};
    s.angular_velocity += static_cast<float>(change.turn);
}

// --- closing gaps -------------------------------------------------------------------------------------------------------------------

void DirectSolve::close_gaps()
{
    for (std::size_t i = 0; i < m_held.size(); ++i)
    {
        const Held& held = m_held[i];
        const JointRow(&rows)[2] = held.work->rows.held;
        m_residual[i] = {as_double(rows[0].error), held.rows == 2 ? as_double(rows[1].error) : 0};
    }
    find_impulses();
    for (Node& n : m_nodes)
        n.shift = {};
    for (std::size_t i = 0; i < m_held.size(); ++i)
    {
        note_shift(m_held[i].up, momentum(m_jacobians[i].up, m_impulse[i]));
        note_shift(m_held[i].down, momentum(m_jacobians[i].down, m_impulse[i]));
    }
    // A step that would turn a body far is taken in part.
    double most = 0.5;
    for (const Node& n : m_nodes)
        most = std::max(most, std::fabs(n.shift.turn));
    for (const Node& n : m_nodes)
        shift(n, 0.5 / most);
}

void DirectSolve::note_shift(int body, const Triple& momentum)
{
    const Triple change = product(m_masses[static_cast<std::size_t>(body)], momentum);
    Triple& sum = node(body).shift;
    sum = {sum.x + change.x, sum.y + change.y, sum.turn + change.turn};
}

void DirectSolve::shift(const Node& node, double share)
{
    if (node.state == none)
        return;
    BodyState& s = m_view.states[node.state];
    s.delta_position += Vec2{static_cast<float>(share * node.shift.x), static_cast<float>(share * node.shift.y)};
    s.delta_rotation = Rotation::from_angle(static_cast<float>(share * node.shift.turn)) * s.delta_rotation;
}

void close_gaps(DirectSolve& direct, const SolverView& view, SceneState& state, std::span<JointWork> joints)
{
    for (int i = 0; i < 4; ++i)
    {
        place_joints(view, state, joints);
        direct.prepare(view, state, joints);
        if (direct.is_ready())
            direct.close_gaps();
    }
}

} // namespace carom::internal
