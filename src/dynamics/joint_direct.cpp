// What the joints of a small unit hold, all at once. One row after the other they never agree: a double pendulum loses 6 % of its energy in
// a minute.
//
//   C_i = error of row i at the pose that the present velocities lead to
//   sum over j of J_i M^-1 J_j^T lambda_j = -C_i / h,  two Newton passes; in the relaxation J v = 0 at the pose reached
//
// With the drift along parabolas that is the RATTLE integrator, which neither gains nor loses energy.
//
// A load that stretches a body between its joints makes it swing like a taut string, with omega² = f · r / I for the pull f at the arm r. A
// sub-step can follow that only while omega h is below 1: beyond it the body counts as harder to turn, just so far. Loops make the system
// singular: soft rows take those.

#include "dynamics/joint_direct.h"

#include "dynamics/scene_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

constexpr float most_stretch = 1; // (omega h)²

double as_double(float x) { return static_cast<double>(x); }

} // namespace

void DirectSolve::prepare(const SolverView& view, SceneState& state, std::span<const JointWork> joints)
{
    m_view = view;
    m_state = &state;
    m_joints = joints;
    m_turns_too_far = false;
    m_ready = collect() && m_count > 0;
    if (!m_ready)
        return;
    m_residual.resize(m_rows.size());
    m_impulse.resize(m_rows.size());
    fill_matrix();
    m_ready = factor();
}

bool DirectSolve::collect()
{
    m_rows.clear();
    m_nodes.clear();
    m_longest_arm = 0;
    for (std::size_t i = 0; i < m_joints.size(); ++i)
    {
        const JointWork& work = m_joints[i];
        if (is_in_flight(m_view, work))
            continue;
        const JointRows rows = holding(work.rows);
        if (rows.count == 0)
            continue;
        if (m_rows.size() + static_cast<std::size_t>(rows.count) > most_rows || !connect(work, work.pose, rows))
            return false;
        for (int r = 0; r < rows.count; ++r)
            m_rows.push_back({static_cast<int>(i), node_of(work.a), node_of(work.b), rows.rows[r]});
    }
    m_count = static_cast<int>(m_rows.size());
    for (Node& n : m_nodes)
        set_masses(n);
    return true;
}

void DirectSolve::set_masses(Node& node) const
{
    if (node.state == none)
        return;
    const StateConstants& c = m_view.constants[node.state];
    node.inverse_mass = c.inverse_mass;
    node.inverse_inertia = c.inverse_inertia * std::min(most_stretch / std::max(node.stretch, most_stretch), 1.0f);
}

// False where the two were connected already: a loop.
bool DirectSolve::connect(const JointWork& work, const JointPose& pose, const JointRows& rows)
{
    const JointRecord& joint = m_state->joints[work.joint];
    Vec2 pull{}; // on b, over a sub-step
    for (int r = 0; r < rows.count; ++r)
        pull += joint.impulses[rows.rows[r].slot] * rows.rows[r].d;
    const int a = node_of(work.a);
    const int b = node_of(work.b);
    m_longest_arm = std::max({m_longest_arm, length(pose.ra), length(pose.rb)});
    node(a).stretch -= m_view.h * m_view.constants[work.a].inverse_inertia * dot(pull, pose.ra);
    node(b).stretch += m_view.h * m_view.constants[work.b].inverse_inertia * dot(pull, pose.rb);
    const int old = node(a).tree;
    const int joined = node(b).tree;
    for (Node& n : m_nodes)
    {
        if (n.tree == old)
            n.tree = joined;
    }
    return old != joined;
}

// All that do not move are one.
int DirectSolve::node_of(std::int32_t state)
{
    const bool moves = (m_view.states[state].flags & body_flag::dynamic) != 0;
    const std::int32_t key = moves ? state : none;
    const auto found = std::find_if(m_nodes.begin(), m_nodes.end(), [&](const Node& n) { return n.state == key; });
    const auto index = static_cast<int>(found - m_nodes.begin());
    if (found == m_nodes.end())
        m_nodes.push_back({.state = key, .tree = index});
    return index;
}

// --- the matrix ---------------------------------------------------------------------------------------------------------------------

void DirectSolve::fill_matrix()
{
    m_first.resize(m_rows.size());
    m_matrix.resize(m_rows.size() * m_rows.size());
    for (int i = 0; i < m_count; ++i)
    {
        int& first = m_first[static_cast<std::size_t>(i)];
        first = i;
        for (int j = i; j >= 0; --j)
        {
            at(i, j) = couple(row(i), row(j));
            if (at(i, j) != 0)
                first = j;
        }
    }
}

// J_i M^-1 J_j^T
double DirectSolve::couple(const Row& i, const Row& j)
{
    double sum = 0;
    const auto add = [&](const Node& body, float arm_i, float arm_j, double sign)
    {
        sum += sign * (as_double(i.row.d.x) * as_double(j.row.d.x) * as_double(body.inverse_mass.x) +
                       as_double(i.row.d.y) * as_double(j.row.d.y) * as_double(body.inverse_mass.y) +
                       as_double(arm_i) * as_double(arm_j) * as_double(body.inverse_inertia));
    };
    if (i.a == j.a)
        add(node(i.a), i.row.arm_a, j.row.arm_a, 1);
    if (i.b == j.b)
        add(node(i.b), i.row.arm_b, j.row.arm_b, 1);
    if (i.a == j.b)
        add(node(i.a), i.row.arm_a, j.row.arm_b, -1);
    if (i.b == j.a)
        add(node(i.b), i.row.arm_b, j.row.arm_a, -1);
    return sum;
}

// Cholesky in place, from the first entry of each row on: along a chain it costs no more than the chain is long. False where rows say the same
// thing twice (loops).
bool DirectSolve::factor()
{
    for (int i = 0; i < m_count; ++i)
    {
        for (int j = m_first[static_cast<std::size_t>(i)]; j < i; ++j)
            at(i, j) = reduced(i, j) / at(j, j);
        const double diagonal = at(i, i);
        const double rest = reduced(i, i);
        if (!(rest > 1e-10 * diagonal))
            return false;
        at(i, i) = std::sqrt(rest);
    }
    return true;
}

double DirectSolve::reduced(int i, int j)
{
    double sum = at(i, j);
    for (int m = std::max(m_first[static_cast<std::size_t>(i)], m_first[static_cast<std::size_t>(j)]); m < j; ++m)
        sum -= at(i, m) * at(j, m);
    return sum;
}

void DirectSolve::substitute()
{
    for (int i = 0; i < m_count; ++i)
    {
        double sum = -m_residual[static_cast<std::size_t>(i)];
        for (int m = m_first[static_cast<std::size_t>(i)]; m < i; ++m)
            sum -= at(i, m) * m_impulse[static_cast<std::size_t>(m)];
        m_impulse[static_cast<std::size_t>(i)] = sum / at(i, i);
    }
    for (int i = m_count - 1; i >= 0; --i)
    {
        const double x = m_impulse[static_cast<std::size_t>(i)] / at(i, i);
        m_impulse[static_cast<std::size_t>(i)] = x;
        for (int m = m_first[static_cast<std::size_t>(i)]; m < i; ++m)
            m_impulse[static_cast<std::size_t>(m)] -= at(i, m) * x;
    }
}

// --- errors and impulses --------------------------------------------------------------------------------------------------------------

void DirectSolve::solve(bool use_bias)
{
    if (!use_bias || !find_pose_ahead())
        keep_together();
}

void DirectSolve::keep_together()
{
    note_speeds();
    substitute();
    apply();
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
    substitute();
    apply();
    note_errors_ahead();
    const double after = largest_error();
    m_turns_too_far = after > 0.5 * before && after > 1e-3;
    if (m_turns_too_far)
    {
        apply(-1); // taken back
        return false;
    }
    substitute();
    apply();
    return true;
}

// In units of the longest arm, or rad.
double DirectSolve::largest_error() const
{
    double largest = 0;
    for (int i = 0; i < m_count; ++i)
    {
        const double size = row(i).row.d == Vec2{} ? 1 : as_double(m_longest_arm);
        largest = std::max(largest, std::fabs(m_residual[static_cast<std::size_t>(i)]) / size);
    }
    return as_double(m_view.h) * largest;
}

void DirectSolve::close_gaps()
{
    for (int i = 0; i < m_count; ++i)
        m_residual[static_cast<std::size_t>(i)] = as_double(row(i).row.error);
    substitute();
    for (int i = 0; i < m_count; ++i)
    {
        const Row& r = row(i);
        const auto impulse = static_cast<float>(m_impulse[static_cast<std::size_t>(i)]);
        note_shift(node(r.a), r.row, r.row.arm_a, -impulse);
        note_shift(node(r.b), r.row, r.row.arm_b, impulse);
    }
    // A step that would turn a body far is taken in part.
    float most = 0.5f;
    for (const Node& n : m_nodes)
        most = std::max(most, std::fabs(n.turn));
    for (const Node& n : m_nodes)
        shift(n, 0.5f / most);
}

void DirectSolve::note_shift(Node& node, const JointRow& row, float arm, float impulse)
{
    node.shift += Vec2{impulse * node.inverse_mass.x * row.d.x, impulse * node.inverse_mass.y * row.d.y};
    node.turn += impulse * node.inverse_inertia * arm;
}

void DirectSolve::shift(const Node& node, float share)
{
    if (node.state == none)
        return;
    BodyState& s = m_view.states[node.state];
    s.delta_position += share * node.shift;
    s.delta_rotation = Rotation::from_angle(share * node.turn) * s.delta_rotation;
}

void DirectSolve::warm_start()
{
    for (int i = 0; i < m_count; ++i)
        push(row(i), impulse_of(row(i)));
}

void DirectSolve::start_anew()
{
    for (int i = 0; i < m_count; ++i)
        push(row(i), -std::exchange(impulse_of(row(i)), 0.0f));
}

void DirectSolve::note_speeds()
{
    for (int i = 0; i < m_count; ++i)
        m_residual[static_cast<std::size_t>(i)] = as_double(JointBodies(m_view, work(row(i))).speed(row(i).row));
}

void DirectSolve::note_errors_ahead()
{
    for (Node& n : m_nodes)
    {
        if (n.state != none)
            n.ahead = placed_ahead(m_view, n.state);
    }
    const auto ahead_of = [&](const Node& n, std::int32_t state)
    { return n.state != none ? n.ahead : placed_ahead(m_view, state); };
    int i = 0;
    while (i < m_count)
    {
        const JointWork& joint = work(row(i));
        const JointPose pose = joint_pose(joint, ahead_of(node(row(i).a), joint.a), ahead_of(node(row(i).b), joint.b));
        const JointRows ahead = holding_rows(m_state->joints[joint.joint], pose);
        for (int r = 0; r < ahead.count; ++r)
            m_residual[static_cast<std::size_t>(i++)] = as_double(m_view.inverse_h) * as_double(ahead.rows[r].error);
    }
}

void DirectSolve::apply(float sign)
{
    for (int i = 0; i < m_count; ++i)
    {
        const float impulse = sign * static_cast<float>(m_impulse[static_cast<std::size_t>(i)]);
        push(row(i), impulse);
        impulse_of(row(i)) += impulse;
    }
}

void DirectSolve::push(const Row& r, float impulse)
{
    const auto turn = [&](int body, float arm, float by)
    {
        const Node& n = node(body);
        if (n.state == none)
            return;
        BodyState& s = m_view.states[n.state];
        s.velocity.x += by * n.inverse_mass.x * r.row.d.x;
        s.velocity.y += by * n.inverse_mass.y * r.row.d.y;
        s.angular_velocity += by * n.inverse_inertia * arm;
    };
    turn(r.a, r.row.arm_a, -impulse);
    turn(r.b, r.row.arm_b, impulse);
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
