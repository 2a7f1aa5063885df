// The matrix of a direct joint solve. Two joints couple where they share a movable body: A_ik = J_ip M_p^-1 J_kp^T, summed over the shared bodies p;
// A_ii sums over both bodies of i. The matrix is symmetric and sparse. It is factored as A = L D L^T, column by column: from each column, the earlier ones
// that have an entry in its row are subtracted. Joints are eliminated by minimum degree, which creates no fill-in for a tree and little for loops. A body
// with k joints costs k³. Everything is computed in double.
//
// Loops may have redundant rows. A small compliance, relative to each row's own inverse mass, shares the impulse among such rows: of the many ways to
// share it, the one with the least impulses. It applies to the whole impulse of a sub-step, warm start included. A part of the impulse that causes no
// motion thus cannot grow from one sub-step to the next.

#include "dynamics/solver/joint/direct/joint_matrix.h"

#include "core/index.h"
#include "core/union_find.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace carom::internal {

namespace {

constexpr double least_rest = 1e-10; // relative to a diagonal entry, after the earlier columns are subtracted

// The inverse mass of one body along a row's line, in the direction in which it is the greatest; for the row of an angle, the inverse inertia.
double weight_of(const Triple& j, double arm, const Triple& mass)
{
    const double line = j.x * j.x + j.y * j.y;
    if (line == 0)
        return j.turn * j.turn * mass.turn;
    const double along = std::max(mass.x, mass.y);
    return line * (along > 0 ? along : arm * mass.turn);
}

void insert(std::vector<int>& sorted, int value)
{
    const auto at = std::lower_bound(sorted.begin(), sorted.end(), value);
    if (at == sorted.end() || *at != value)
        sorted.insert(at, value);
}

} // namespace

void JointMatrix::lay_out(std::span<const Edge> edges, int nodes)
{
    m_edges.assign(edges.begin(), edges.end());
    find_loops(nodes);
    Neighbors neighbors = couple_edges(nodes);
    order(neighbors);
    lay_out_columns(neighbors);
    find_entries();
}

// --- structure ----------------------------------------------------------------------------------------------------------------------

void JointMatrix::find_loops(int nodes)
{
    UnionFind trees;
    trees.reset(as_index(nodes));
    m_has_loops = false;
    for (const Edge& e : m_edges)
        m_has_loops |= !trees.link(e.a, e.b, false);
}

JointMatrix::Neighbors JointMatrix::couple_edges(int nodes)
{
    std::vector<std::vector<int>> edges_of(as_index(nodes));
    for (std::size_t i = 0; i < m_edges.size(); ++i)
    {
        for (const int node : {m_edges[i].a, m_edges[i].b})
            insert(edges_of[as_index(node)], static_cast<int>(i));
    }
    Neighbors neighbors(m_edges.size());
    m_couplings.clear();
    for (int node = ground + 1; node < nodes; ++node)
    {
        for (const int i : edges_of[as_index(node)])
        {
            for (const int k : edges_of[as_index(node)])
            {
                if (i == k)
                    continue;
                insert(neighbors[as_index(i)], k);
                if (i < k)
                    m_couplings.push_back({.first = i, .second = k, .node = node});
            }
        }
    }
    return neighbors;
}

// Leaves for each edge the neighbors that are eliminated later.
void JointMatrix::order(Neighbors& neighbors)
{
    std::set<std::pair<std::size_t, int>> left; // by number of neighbors
    const auto key = [&](int i) { return std::pair(neighbors[as_index(i)].size(), i); };
    for (int i = 0; i < static_cast<int>(m_edges.size()); ++i)
        left.insert(key(i));
    m_order.clear();
    while (!left.empty())
    {
        const int edge = left.begin()->second;
        left.erase(left.begin());
        m_order.push_back(edge);
        const std::vector<int>& later = neighbors[as_index(edge)];
        for (const int i : later)
        {
            std::vector<int>& of = neighbors[as_index(i)];
            left.erase(key(i));
            of.erase(std::ranges::lower_bound(of, edge));
            for (const int k : later)
            {
                if (k != i)
                    insert(of, k);
            }
            left.insert(key(i));
        }
    }
}

void JointMatrix::lay_out_columns(const Neighbors& later)
{
    m_first_row.assign(m_edges.size(), 0);
    int count = 0;
    for (const int edge : m_order)
    {
        m_first_row[as_index(edge)] = count;
        count += m_edges[as_index(edge)].rows;
    }
    m_column_starts.assign(1, 0);
    m_rows.clear();
    const auto add_rows = [&](int edge, int from)
    {
        for (int r = from; r < m_edges[as_index(edge)].rows; ++r)
            m_rows.push_back(first_row(as_index(edge)) + r);
    };
    for (const int edge : m_order)
    {
        std::vector<int> in_order = later[as_index(edge)];
        std::ranges::sort(in_order, {}, [&](int i) { return first_row(as_index(i)); });
        for (int r = 0; r < m_edges[as_index(edge)].rows; ++r)
        {
            add_rows(edge, r + 1);
            for (const int other : in_order)
                add_rows(other, 0);
            m_column_starts.push_back(static_cast<int>(m_rows.size()));
        }
    }
    for (std::vector<double>* values : {&m_diagonal, &m_weights, &m_pivots, &m_work})
        values->assign(as_index(count), 0);
    m_entries.assign(m_rows.size(), 0);
    m_factor.assign(m_rows.size(), 0);
}

void JointMatrix::find_entries()
{
    const auto entry = [&](int row, int column)
    {
        const auto first = m_rows.begin() + m_column_starts[as_index(column)];
        const auto last = m_rows.begin() + m_column_starts[as_index(column) + 1];
        return static_cast<int>(std::lower_bound(first, last, row) - m_rows.begin());
    };
    for (Coupling& c : m_couplings)
    {
        if (first_row(as_index(c.second)) < first_row(as_index(c.first)))
            std::swap(c.first, c.second);
        c.first_by_a = m_edges[as_index(c.first)].a == c.node;
        c.second_by_a = m_edges[as_index(c.second)].a == c.node;
        for (int r = 0; r < m_edges[as_index(c.first)].rows; ++r)
            c.entries[r] = entry(first_row(as_index(c.second)), first_row(as_index(c.first)) + r);
    }
    std::vector<std::vector<Hit>> by_row(m_diagonal.size());
    for (int column = 0; column < rows(); ++column)
    {
        for (int i = m_column_starts[as_index(column)]; i < m_column_starts[as_index(column) + 1]; ++i)
            by_row[as_index(m_rows[as_index(i)])].push_back({column, i});
    }
    m_hits.clear();
    m_hit_starts.assign(1, 0);
    for (const std::vector<Hit>& hits : by_row)
    {
        m_hits.insert(m_hits.end(), hits.begin(), hits.end());
        m_hit_starts.push_back(static_cast<int>(m_hits.size()));
    }
}

// --- values -------------------------------------------------------------------------------------------------------------------------

void JointMatrix::fill(std::span<const JointJacobian> jacobians, std::span<const Triple> masses)
{
    std::ranges::fill(m_entries, 0);
    for (std::size_t i = 0; i < m_edges.size(); ++i)
        fill_own(i, jacobians[i], masses);
    for (const Coupling& c : m_couplings)
    {
        const JointJacobian& first = jacobians[as_index(c.first)];
        const JointJacobian& second = jacobians[as_index(c.second)];
        const Triple(&of_first)[most_joint_rows] = c.first_by_a ? first.a : first.b;
        const Triple(&of_second)[most_joint_rows] = c.second_by_a ? second.a : second.b;
        for (int r = 0; r < m_edges[as_index(c.first)].rows; ++r)
        {
            const Triple moved = product(of_first[r], masses[as_index(c.node)]);
            for (int q = 0; q < m_edges[as_index(c.second)].rows; ++q)
                m_entries[as_index(c.entries[r] + q)] += dot(moved, of_second[q]);
        }
    }
}

void JointMatrix::fill_own(std::size_t edge, const JointJacobian& jacobian, std::span<const Triple> masses)
{
    const Edge& e = m_edges[edge];
    for (int r = 0; r < e.rows; ++r)
    {
        const Triple by_a = product(jacobian.a[r], masses[as_index(e.a)]);
        const Triple by_b = product(jacobian.b[r], masses[as_index(e.b)]);
        const std::size_t row = as_index(first_row(edge) + r);
        m_diagonal[row] = dot(by_a, jacobian.a[r]) + dot(by_b, jacobian.b[r]);
        m_weights[row] = weight_of(jacobian.a[r], jacobian.arm_a, masses[as_index(e.a)]) +
                         weight_of(jacobian.b[r], jacobian.arm_b, masses[as_index(e.b)]);
        for (int q = r + 1; q < e.rows; ++q)
            m_entries[as_index(m_column_starts[row] + q - r - 1)] = dot(by_a, jacobian.a[q]) + dot(by_b, jacobian.b[q]);
    }
}

void JointMatrix::factor(std::span<const double> compliances, double of_all)
{
    for (std::size_t column = 0; column < m_diagonal.size(); ++column)
    {
        const int first = m_column_starts[column];
        const int last = m_column_starts[column + 1];
        for (int i = first; i < last; ++i)
            m_work[as_index(m_rows[as_index(i)])] = m_entries[as_index(i)];
        double pivot = m_diagonal[column] + of_all * m_weights[column] + compliances[column];
        const double least = least_rest * pivot;
        for (int hit = m_hit_starts[column]; hit < m_hit_starts[column + 1]; ++hit)
        {
            const Hit& before = m_hits[as_index(hit)];
            const double l = m_factor[as_index(before.entry)];
            if (l == 0)
                continue;
            const double by = l / m_pivots[as_index(before.column)];
            pivot -= l * by;
            for (int i = before.entry + 1; i < m_column_starts[as_index(before.column) + 1]; ++i)
                m_work[as_index(m_rows[as_index(i)])] -= by * m_factor[as_index(i)];
        }
        const bool gives = compliances[column] != off && pivot > least;
        m_pivots[column] = gives ? 1 / pivot : 0;
        for (int i = first; i < last; ++i)
            m_factor[as_index(i)] = m_pivots[column] * m_work[as_index(m_rows[as_index(i)])];
    }
}

template <class T>
void JointMatrix::eliminate(std::span<T> values, std::size_t column) const
{
    const T own = values[column];
    if (own == T{})
        return;
    for (int i = m_column_starts[column]; i < m_column_starts[column + 1]; ++i)
        values[as_index(m_rows[as_index(i)])] -= m_factor[as_index(i)] * own;
}

template <class T>
void JointMatrix::substitute(std::span<T> values, std::size_t column) const
{
    T own = m_pivots[column] * values[column];
    for (int i = m_column_starts[column]; i < m_column_starts[column + 1]; ++i)
        own -= m_factor[as_index(i)] * values[as_index(m_rows[as_index(i)])];
    values[column] = own;
}

void JointMatrix::solve(std::span<double> values) const
{
    for (std::size_t column = 0; column < m_diagonal.size(); ++column)
        eliminate(values, column);
    for (std::size_t column = m_diagonal.size(); column-- > 0;)
        substitute(values, column);
}

void JointMatrix::solve(std::span<Triple> values, std::span<const int> rows) const
{
    for (std::size_t i = 0; i < rows.size(); ++i)
        eliminate(values, as_index(rows[i]));
    for (std::size_t i = rows.size(); i-- > 0;)
        substitute(values, as_index(rows[i]));
}

} // namespace carom::internal
