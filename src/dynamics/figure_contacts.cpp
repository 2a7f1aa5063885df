// Contacts of figures: bodies that joints hold together are pushed as a whole. A contact that knew its own body alone would stop a foot and let the
// joints push it on, turn after turn, as slowly as the foot is lighter than what it carries.
//
//   u = M^-1 j^T,  lambda = -A^-1 J u,  w = u + M^-1 J^T lambda       what a unit impulse along j and the answer of the joints do
//   impulse = -(j v + bias) / (j w)
//
// A figure that is held by what does not give way has no such answer everywhere: a wall may contradict its joints, and these have to yield. There, and
// between two bodies of one figure, contacts push their own bodies alone and joints and contacts take turns.

#include "dynamics/joint_direct.h"

#include "core/index.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

// The least share of a body's own answer that counts: below it joints leave rounding alone, as of a turn that another body's lock forbids.
constexpr double least_answer = 1e-9;

// A row has a normal and a friction line for each point, and one for rolling.
constexpr std::size_t lines_per_row = 5;

float clamped_change(float& impulse, float change, float least, float most)
{
    const float now = std::clamp(impulse + change, least, most);
    return now - std::exchange(impulse, now);
}

} // namespace

// --- figures ------------------------------------------------------------------------------------------------------------------------

void DirectSolve::find_figures()
{
    m_figures.clear();
    m_figure_of.assign(m_nodes.size(), none);
    for (std::size_t first = JointMatrix::ground + 1; first < m_nodes.size(); ++first)
    {
        if (m_figure_of[first] != none)
            continue;
        const int number = static_cast<int>(m_figures.size());
        Figure& figure = m_figures.emplace_back();
        m_figure_of[first] = number;
        figure.nodes.assign(1, static_cast<int>(first));
        for (bool grows = true; std::exchange(grows, false);)
        {
            for (const Item& item : m_items)
            {
                if (item.a == JointMatrix::ground || item.b == JointMatrix::ground ||
                    (m_figure_of[as_index(item.a)] == number) == (m_figure_of[as_index(item.b)] == number))
                    continue;
                const int added = m_figure_of[as_index(item.a)] == number ? item.b : item.a;
                m_figure_of[as_index(added)] = number;
                figure.nodes.push_back(added);
                grows = true;
            }
        }
        std::ranges::sort(figure.nodes);
        for (std::size_t i = 0; i < m_items.size(); ++i)
        {
            const Item& item = m_items[i];
            if (m_figure_of[as_index(item.a)] != number && m_figure_of[as_index(item.b)] != number)
                continue;
            figure.items.push_back(static_cast<int>(i));
            const Edge& edge = m_edges[i];
            for (int r = 0; r < edge.held + (edge.has_axis ? 1 : 0); ++r)
                figure.rows.push_back(item.first_row + r);
        }
        std::ranges::sort(figure.rows);
    }
}

void DirectSolve::find_anchors()
{
    m_has_free_figures = false;
    for (Figure& figure : m_figures)
    {
        const auto holds = [&](int i)
        { return m_items[as_index(i)].a == JointMatrix::ground || m_items[as_index(i)].b == JointMatrix::ground; };
        figure.anchored = std::ranges::any_of(figure.items, holds) ||
                          std::ranges::any_of(figure.nodes, [&](int n) { return is_locked(m_nodes[as_index(n)]); });
        m_has_free_figures |= !figure.anchored;
    }
}

// None where it belongs to no figure that may be pushed as a whole.
int DirectSolve::free_figure_of(std::int32_t state) const
{
    if (moving(state) == none)
        return none;
    const auto at = as_index(node_of(state));
    if (at >= m_nodes.size() || m_nodes[at].state != state)
        return none;
    const int figure = m_figure_of[at];
    return m_figures[as_index(figure)].anchored ? none : figure;
}

// --- answers of the joints ----------------------------------------------------------------------------------------------------------

DirectSolve::PushedSide DirectSolve::pushed_side(std::int32_t state, int figure, Triple jacobian)
{
    PushedSide side;
    side.state = state;
    side.figure = figure;
    const StateConstants& c = m_view.constants[state];
    side.alone = product(as_triple(c.inverse_mass, c.inverse_inertia), jacobian);
    if (figure == none)
    {
        side.k = dot(jacobian, side.alone);
        return side;
    }
    const Figure& whole = m_figures[as_index(figure)];
    m_kept.clear();
    for (const int n : whole.nodes)
        m_kept.push_back(std::exchange(node(n).change, {}));
    const int own = node_of(state);
    node(own).change = product(m_masses[as_index(own)], jacobian);
    m_answer.resize(as_index(m_matrix.rows()));
    for (const int i : whole.items)
    {
        const Item& item = m_items[as_index(i)];
        for (int r = 0; r < item.rows(); ++r)
            m_answer[as_index(item.first_row + r)] = -change_along(item, r);
    }
    m_matrix.solve(m_answer, whole.rows);
    for (const int i : whole.items)
    {
        const Item& item = m_items[as_index(i)];
        for (int r = 0; r < item.rows(); ++r)
        {
            double& answer = m_answer[as_index(item.first_row + r)];
            if (m_compliances[as_index(item.first_row + r)] == JointMatrix::off)
                answer = 0;
            else
                push(item, r, answer);
        }
    }
    side.k = dot(jacobian, node(own).change);
    side.first_change = m_changes.size();
    side.first_answer = m_answers.size();
    for (std::size_t i = 0; i < whole.nodes.size(); ++i)
        m_changes.push_back(std::exchange(node(whole.nodes[i]).change, m_kept[i]));
    for (const int row : whole.rows)
        m_answers.push_back(m_answer[as_index(row)]);
    return side;
}

const DirectSolve::PushedLine& DirectSolve::pushed_line(const ContactRow& row, std::size_t number, Triple ja, Triple jb)
{
    int& at = m_line_of[number];
    if (at == none)
    {
        at = static_cast<int>(m_lines.size());
        const PushedSide a = pushed_side(row.a, free_figure_of(row.a), ja);
        const PushedSide b = pushed_side(row.b, free_figure_of(row.b), jb);
        const double k = a.k + b.k;
        const double alone = dot(ja, a.alone) + dot(jb, b.alone);
        m_lines.push_back({a, b, k > least_answer * alone ? static_cast<float>(1 / k) : 0});
    }
    return m_lines[as_index(at)];
}

void DirectSolve::push_whole(const PushedLine& line, float impulse)
{
    if (impulse == 0 || line.mass == 0)
        return;
    push_whole(line.a, static_cast<double>(impulse));
    push_whole(line.b, static_cast<double>(impulse));
    m_largest_push = std::max(m_largest_push, std::fabs(impulse) / line.mass);
}

void DirectSolve::push_whole(const PushedSide& side, double impulse)
{
    const auto give = [&](std::int32_t state, const Triple& change)
    {
        BodyState& s = m_view.states[state];
        s.velocity += Vec2{static_cast<float>(impulse * change.x), static_cast<float>(impulse * change.y)};
        s.angular_velocity += static_cast<float>(impulse * change.turn);
    };
    if (side.figure == none)
    {
        give(side.state, side.alone);
        return;
    }
    const Figure& whole = m_figures[as_index(side.figure)];
    for (std::size_t i = 0; i < whole.nodes.size(); ++i)
    {
        const Triple& change = m_changes[side.first_change + i];
        give(node(whole.nodes[i]).state, change);
        node(whole.nodes[i]).change += impulse * change;
    }
    for (std::size_t i = 0; i < whole.rows.size(); ++i)
        m_answered[as_index(whole.rows[i])] += impulse * m_answers[side.first_answer + i];
}

// --- passes -------------------------------------------------------------------------------------------------------------------------

void DirectSolve::solve_contacts(std::span<ContactRow> rows, std::span<ContactRow> late_rows, bool use_bias, float tiny)
{
    constexpr int most_sweeps = 4;
    m_lines.clear();
    m_changes.clear();
    m_answers.clear();
    m_answered.assign(m_impulses.size(), 0);
    m_line_of.assign(lines_per_row * (rows.size() + late_rows.size()), none);
    for (int sweep = 0; sweep < most_sweeps; ++sweep)
    {
        m_largest_push = 0;
        std::size_t number = 0;
        for (const std::span<ContactRow> some : {rows, late_rows})
        {
            for (std::size_t i = 0; i < some.size(); ++i, number += lines_per_row)
            {
                const int a = free_figure_of(some[i].a);
                const int b = free_figure_of(some[i].b);
                if (a == b) // in one figure, or in none
                    solve_rows(m_view, some.subspan(i, 1), use_bias);
                else
                    solve_contact(some[i], number, use_bias);
            }
        }
        if (m_largest_push < tiny)
            break;
    }
    take_answers();
}

void DirectSolve::solve_contact(ContactRow& row, std::size_t number, bool use_bias)
{
    const auto line = [&](std::size_t which, Vec2 d, const RowPoint& p) -> const PushedLine&
    { return pushed_line(row, number + which, as_triple(-d, -cross(p.ra, d)), as_triple(d, cross(p.rb, d))); };
    float load = 0;
    for (int i = 0; i < row.count; ++i)
        load += row.points[i].normal_impulse;
    if (row.rolling > 0 && (load > 0 || row.rolling_impulse != 0))
    {
        const PushedLine& turn = pushed_line(row, number + lines_per_row - 1, {0, 0, -1}, {0, 0, 1});
        const float slip = m_view.states[row.b].angular_velocity - m_view.states[row.a].angular_velocity;
        push_whole(turn, clamped_change(row.rolling_impulse, -turn.mass * slip, -row.rolling * load, row.rolling * load));
    }
    for (int i = 0; i < row.count; ++i)
    {
        RowPoint& p = row.points[i];
        const NormalTarget target = normal_target(m_view, row, p, use_bias);
        const float lacking = row_speed(m_view, row, p) + target.bias;
        if (p.normal_impulse == 0 && lacking >= 0)
            continue;
        const PushedLine& normal = line(static_cast<std::size_t>(i), row.n, p);
        const float change = -normal.mass * target.mass_scale * lacking - target.impulse_scale * p.normal_impulse;
        push_whole(normal, clamped_change(p.normal_impulse, change, 0, 3e38f)); // contacts push and never pull
    }
    for (int i = 0; i < row.count; ++i)
    {
        RowPoint& p = row.points[i];
        const float limit = row.friction * p.normal_impulse;
        if (limit == 0 && p.tangent_impulse == 0)
            continue;
        const Vec2 t = perp(row.n);
        const PushedLine& along = line(2 + static_cast<std::size_t>(i), t, p);
        push_whole(along, clamped_change(p.tangent_impulse, -along.mass * row_slip(m_view, row, p), -limit, limit));
    }
}

void DirectSolve::take_answers()
{
    for (std::size_t i = 0; i < m_impulses.size(); ++i)
        m_impulses[i] += m_answered[i];
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            item.impulse(r) += static_cast<float>(m_answered[as_index(item.first_row + r)]);
    }
    // A motor may have answered with more than it can do: the next solve knows and takes it back.
    for (const Axis& axis : m_axes)
    {
        const double answered = m_answered[as_index(axis.row)];
        if (answered == 0)
            continue;
        AxisImpulses now = axis.law.split(axis.piece, axis.before + m_impulses[as_index(axis.row)], rate_of_law(axis));
        now.motor += axis.before + m_impulses[as_index(axis.row)] - now.sum();
        set_axis_impulses(*m_items[axis.item].record, axis.law.scope.merge(axis.restore, now));
    }
}

} // namespace carom::internal
