// The impulses of a Newton step, by an active-set method. Each axis is solved with the piece of its law that it seems to be on, until each is on the piece
// that its law has at the rate and impulse found.

#include "dynamics/solver/joint/direct/direct_solver.h"

#include "core/as_double.h"
#include "core/index.h"
#include "dynamics/state/scene_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

constexpr std::size_t rounds_of_all = 8; // in which all axes may change pieces; then one axis changes at a time, which terminates
constexpr std::size_t most_rounds = 64;  // and one for each axis
constexpr double yielding_compliance = 1; // relative to a row's weight
constexpr double same_rate = 1e-6;
constexpr double least_share = 1e-3; // share of a spring's compliance that is left where its row is softer

} // namespace

void DirectSolve::find_impulses(Stage stage)
{
    begin_axes(stage);
    for (std::size_t round = 0;; ++round)
    {
        solve_pieces();
        if (!take_next_pieces(round < rounds_of_all))
            return;
        if (round == most_rounds + m_axes.size())
            break;
    }
    give_up_on_pieces();
    solve_pieces();
}

void DirectSolve::begin_axes(Stage stage)
{
    m_compliance = !m_may_contradict ? 0 : loop_compliance * (stage == Stage::Ahead ? m_softening : m_least_softening);
    m_leak = stage == Stage::Ahead ? m_compliance : 0;
    if (m_yields && stage != Stage::Held)
        m_compliance = m_leak = std::max(m_compliance, yielding_compliance);
    m_axes.clear();
    for (std::size_t i = 0; i < m_items.size(); ++i)
    {
        for (const JointAxis& axis : m_items[i].work->rows.axes())
            begin_axis(m_axes.emplace_back(Axis{.item = i, .joint_axis = &axis}), stage);
    }
}

void DirectSolve::begin_axis(Axis& axis, Stage stage)
{
    const Item& item = m_items[axis.item];
    const JointAxis& own = *axis.joint_axis;
    axis.row = item.first_row + item.row_of(own);
    axis.restore = impulses_of(axis);
    if (stage == Stage::Held)
        return;
    const AxisWork& work = item.work->axes[own.number];
    if (stage == Stage::Now)
        axis.law = own.acts.law_now(axis.restore, work.bounce, m_view.h);
    else
        axis.law = acts_ahead(own, stage).law_ahead(work.spring, m_view.h);
    for (SpringLine* spring : {&axis.law.spring, &axis.law.soft_lower, &axis.law.soft_upper})
    { // the softness of the row counts as a part of the spring's own
        const double whole = m_spring_softening * spring->compliance;
        spring->compliance = std::max(whole - softness(axis), least_share * whole);
    }
    axis.before = axis.law.scope.sum(axis.restore);
    const double k = as_double(own.inverse_mass);
    axis.piece = axis.law.solve(m_speeds[as_index(axis.row)] + (softness(axis) - k) * axis.before, k);
}

// Solves the system with every axis on its piece.
void DirectSolve::solve_pieces()
{
    std::ranges::fill(m_wanted_compliances, 0);
    for (const Axis& axis : m_axes)
    {
        if (!axis.piece.keeps_its_rate())
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
        const double speed = m_speeds[as_index(axis.row)] + change_along(axis);
        const double leak = softness(axis) * axis.before;
        double& wanted = m_impulses[as_index(axis.row)];
        const SpringLine& spring = axis.piece.spring;
        if (axis.piece.keeps_its_rate())
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
        if (m_compliances[as_index(axis.row)] == JointMatrix::off)
            m_impulses[as_index(axis.row)] = axis.piece.constant - axis.before;
        else
            push(axis, m_impulses[as_index(axis.row)]);
    }
}

// Applies the impulses of axes that do not depend on the rate.
void DirectSolve::give_known_impulses()
{
    for (Node& n : m_nodes)
        n.change = {};
    for (const Axis& axis : m_axes)
    {
        if (m_compliances[as_index(axis.row)] == JointMatrix::off)
            push(axis, axis.piece.constant - axis.before);
    }
}

// The rate at which an axis' law gives its impulse. It includes the rate at which the row itself yields in proportion to that impulse.
double DirectSolve::rate_of_law(const Axis& axis) const
{
    const double given_rate =
        m_matrix.weight(axis.row) * m_compliance * m_impulses[as_index(axis.row)] + softness(axis) * axis.before;
    return m_speeds[as_index(axis.row)] + change_along(axis) + given_rate;
}

// False if every axis is on the piece where it should be.
bool DirectSolve::take_next_pieces(bool all)
{
    bool changed = false;
    for (Axis& axis : m_axes)
    {
        const double k = as_double(axis.joint_axis->inverse_mass);
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

// Each axis keeps its present impulse; only the held rows change theirs.
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

void DirectSolve::push(const Axis& axis, double impulse)
{
    const Item& item = m_items[axis.item];
    push(item, axis.row - item.first_row, impulse);
}

double DirectSolve::change_along(const Axis& axis) const
{
    const Item& item = m_items[axis.item];
    return change_along(item, axis.row - item.first_row);
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
        const AxisImpulses now = axis.law.split(axis.piece, axis.before + m_impulses[as_index(axis.row)], rate_of_law(axis));
        set_impulses_of(axis, axis.law.scope.merge(axis.restore, now));
    }
}

void DirectSolve::take_back()
{
    straighten_springs();
    take_velocities(-1);
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            item.impulse(r) -= static_cast<float>(m_impulses[as_index(item.first_row + r)]);
    }
    for (const Axis& axis : m_axes)
        set_impulses_of(axis, axis.restore);
}

// The speeds have just been recorded, and contain the impulses given so far.
void DirectSolve::go_on_from_here()
{
    for (Node& n : m_nodes)
        n.change = {};
    std::ranges::fill(m_impulses, 0.0);
    for (Axis& axis : m_axes)
    {
        axis.restore = impulses_of(axis);
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
        for (int r = 0; r < item.rows(); ++r)
            push(item, r, as_double(impulse_of(*item.record, item.work->rows, r)));
    }
    take_velocities();
}

void DirectSolve::start_anew()
{
    straighten_springs();
    for (Node& n : m_nodes)
        n.change = {};
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.rows(); ++r)
            push(item, r, -as_double(impulse_of(*item.record, item.work->rows, r)));
        forget_impulses(*item.record);
    }
    take_velocities();
}

} // namespace carom::internal
