// The setup of the direct solver's equations: the constraint graph, the poses of the joints, and the effective masses of the bodies.

#include "dynamics/solver/joint/direct/direct_solver.h"

#include "core/as_double.h"
#include "core/index.h"
#include "dynamics/state/scene_data.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace carom::internal {

namespace {

constexpr float most_stretch = 1; // (omega h)²

// 0 and -0 differ.
bool is_same(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); }

} // namespace

// --- the constraint graph -----------------------------------------------------------------------------------------------------------

// The graph is the same through the step, unless a body takes off or lands.
void DirectSolve::find_edges()
{
    m_found.clear();
    if (!m_is_wanted)
        return;
    for (std::size_t i = 0; i < m_joints.size(); ++i)
    {
        const JointWork& work = m_joints[i];
        if (work.rows.count() == 0 || is_in_flight(m_view, work))
            continue;
        m_found.push_back({i, moving(work.a), moving(work.b), work.rows.held_count, work.rows.axis_count});
    }
    if (m_found != m_edges)
        lay_out();
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
        edges.push_back({node_of(e.a), node_of(e.b), e.rows()});
    m_matrix.lay_out(edges, static_cast<int>(m_nodes.size()));
    m_items.clear();
    for (std::size_t i = 0; i < m_edges.size(); ++i)
    {
        Item& item = m_items.emplace_back();
        item.joint = m_edges[i].joint;
        item.held = m_edges[i].held;
        item.axes = m_edges[i].axes;
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

// --- poses and masses ---------------------------------------------------------------------------------------------------------------

// False if nothing has changed: a sub-step often begins as the last one has ended.
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
    m_least_softening = m_may_contradict ? std::clamp(softening_of_error * present_error(), least_softening, 1.0) : 1;
    m_softening = stretch > 1 ? stretch * stretch * stretch : m_least_softening;
    for (std::size_t i = JointMatrix::ground + 1; i < m_nodes.size(); ++i)
    {
        const Triple old = std::exchange(m_masses[i], inverse_mass(m_nodes[i]));
        changed |= m_masses[i] != old;
    }
    return changed;
}

// The widest gap in arms, or rad.
double DirectSolve::present_error() const
{
    float length = 0;
    float angle = 0;
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
        {
            float& largest = item.row(r).is_angle ? angle : length;
            largest = std::max(largest, std::fabs(item.row(r).error));
        }
    }
    return as_double(std::max(m_longest_arm > 0 ? length / m_longest_arm : 0, angle));
}

// How far the rows have yielded, per impulse that they bear.
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

// True if the lines differ from the previous ones in any bit.
bool DirectSolve::Item::take_lines()
{
    bool changed = false;
    for (int r = 0; r < rows(); ++r)
    {
        const JointRow& now = row(r);
        Line& line = lines[r];
        changed |= !is_same(now.d.x, line.d.x) || !is_same(now.d.y, line.d.y) || !is_same(now.arm_a, line.arm_a) ||
                   !is_same(now.arm_b, line.arm_b);
        line = {now.d, now.arm_a, now.arm_b, now.is_angle};
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
    for (int r = 0; r < item.rows(); ++r)
        pull += impulse_of(*item.record, work.rows, r) * item.row(r).d;
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
    // Loops yield instead.
    const bool counts_as_harder = m_mass_kind == Masses::Loaded && !m_may_contradict && node.stretch > most_stretch;
    const float share = counts_as_harder ? most_stretch / node.stretch : 1;
    return as_triple(c.inverse_mass, share * c.inverse_inertia);
}

// No oscillation of a chain is faster than that of the two bodies of its stiffest joint against fixed neighbors.
void DirectSolve::fit_springs()
{
    if (!m_ready)
        return;
    for (Node& n : m_nodes)
    {
        n.sprung = 0;
        n.springs = 0;
    }
    const auto for_each_spring = [&](auto&& visit)
    {
        for (const Item& item : m_items)
        {
            for (const JointAxis& axis : item.work->rows.axes())
            {
                AxisSpring& spring = m_joints[item.joint].axes[axis.number].spring;
                if (spring.is_there())
                    visit(item, axis, spring);
            }
        }
    };
    for_each_spring(
        [&](const Item& item, const JointAxis& axis, const AxisSpring& spring)
        {
            add_spring(node(item.a), spring.stiffness, axis.row.d, axis.row.arm_a);
            add_spring(node(item.b), spring.stiffness, axis.row.d, axis.row.arm_b);
        });
    for_each_spring(
        [&](const Item& item, const JointAxis& axis, AxisSpring& spring)
        {
            const Node& a = node(item.a);
            const Node& b = node(item.b);
            const float alone = spring.stiffness * axis.inverse_mass;
            const float rate = a.springs > 1 || b.springs > 1 ? std::max(alone, a.sprung + b.sprung) : alone;
            const float drag = spring.damping * axis.inverse_mass;
            spring.theta = std::max({spring.theta, least_theta(m_view.h * std::sqrt(rate)), least_theta(m_view.h * drag)});
        });
}

void DirectSolve::add_spring(Node& node, float stiffness, Vec2 d, float arm) const
{
    if (node.state == none)
        return;
    const StateConstants& c = m_view.constants[node.state];
    node.sprung += stiffness * (c.inverse_mass.x * d.x * d.x + c.inverse_mass.y * d.y * d.y + c.inverse_inertia * arm * arm);
    ++node.springs;
}

} // namespace carom::internal
