#pragma once

// The matrix of an island's joint equations: A = J M^-1 J^T + C, how the impulse of one row changes the speed along another. C is the compliance of the
// rows. See joint_matrix.cpp.

#include "dynamics/state/scene_state.h"

#include <limits>
#include <span>
#include <vector>

namespace carom::internal {

/// A vector over the coordinates of a body: x, y and angle.
struct Triple
{
    double x = 0;
    double y = 0;
    double turn = 0;

    friend bool operator==(const Triple&, const Triple&) = default;

    Triple& operator+=(const Triple& b)
    {
        x += b.x;
        y += b.y;
        turn += b.turn;
        return *this;
    }
    friend Triple operator-(Triple a, const Triple& b) { return a -= b; }
    Triple& operator-=(const Triple& b)
    {
        x -= b.x;
        y -= b.y;
        turn -= b.turn;
        return *this;
    }
};

[[nodiscard]] constexpr double dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.turn * b.turn; }
[[nodiscard]] constexpr Triple product(const Triple& a, const Triple& b) { return {a.x * b.x, a.y * b.y, a.turn * b.turn}; }
[[nodiscard]] constexpr Triple operator*(double s, const Triple& a) { return {s * a.x, s * a.y, s * a.turn}; }

/// The Jacobian of a joint, by row.
struct JointJacobian
{
    Triple a[most_joint_rows];
    Triple b[most_joint_rows];
    double arm_a = 0; ///< squared lengths of the anchors' arms
    double arm_b = 0;
};

class JointMatrix
{
public:
    static constexpr int ground = 0;                                       ///< node of all immovable bodies
    static constexpr double off = std::numeric_limits<double>::infinity(); ///< compliance of a row that gives no impulse

    /// An edge of the constraint graph, whose nodes are bodies.
    struct Edge
    {
        int a = ground;
        int b = ground;
        int rows = 0;
    };

    /// Done once for a graph, with or without loops: finds the order of elimination and the entries of the factor.
    void lay_out(std::span<const Edge> edges, int nodes);
    [[nodiscard]] int rows() const { return static_cast<int>(m_diagonal.size()); }
    /// The rows of an edge are consecutive.
    [[nodiscard]] int first_row(std::size_t edge) const { return m_first_row[edge]; }
    [[nodiscard]] bool has_loops() const { return m_has_loops; }

    /// The inverse mass or inertia of a row's two bodies along it, by which compliances are measured. For a body that may only turn, it is that of the anchor.
    [[nodiscard]] double weight(int row) const { return m_weights[static_cast<std::size_t>(row)]; }

    /// Computes J M^-1 J^T. Jacobians are by edge; masses are inverse and by node.
    void fill(std::span<const JointJacobian> jacobians, std::span<const Triple> masses);
    /// Factors with a compliance for each row, and one for all rows in proportion to their weights. A row that earlier rows imply gives no impulse.
    void factor(std::span<const double> compliances, double of_all = 0);
    /// A^-1 values, in place.
    void solve(std::span<double> values) const;
    /// The same for three columns of values and for a subset of the rows, in order, that no other row couples to. Other values are unchanged.
    void solve(std::span<Triple> values, std::span<const int> rows) const;

private:
    /// Two edges that share a movable body.
    struct Coupling
    {
        int first = 0; ///< edge that is eliminated first
        int second = 0;
        int node = ground;
        bool first_by_a = false; ///< its body a is the shared one
        bool second_by_a = false;
        int entries[most_joint_rows] = {}; ///< where the rows of the second begin, in each column of the first
    };

    /// An entry of the factor, listed by row.
    struct Hit
    {
        int column = 0;
        int entry = 0;
    };

    using Neighbors = std::vector<std::vector<int>>; ///< by edge, sorted

    template <class T>
    void eliminate(std::span<T> values, std::size_t column) const;
    template <class T>
    void substitute(std::span<T> values, std::size_t column) const;
    void find_loops(int nodes);
    [[nodiscard]] Neighbors couple_edges(int nodes);
    void order(Neighbors& neighbors);
    void lay_out_columns(const Neighbors& later);
    void find_entries();
    void fill_own(std::size_t edge, const JointJacobian& jacobian, std::span<const Triple> masses);

    std::vector<Edge> m_edges;
    std::vector<Coupling> m_couplings;
    std::vector<int> m_order;     ///< edges in the order of elimination
    std::vector<int> m_first_row; ///< by edge
    bool m_has_loops = false;

    std::vector<int> m_column_starts; ///< first entry below the diagonal, by column
    std::vector<int> m_rows;          ///< row of each entry
    std::vector<int> m_hit_starts;    ///< first hit, by row
    std::vector<Hit> m_hits;
    std::vector<double> m_diagonal; ///< diagonal of A
    std::vector<double> m_weights;
    std::vector<double> m_entries;
    std::vector<double> m_pivots; ///< inverse pivots of the factor
    std::vector<double> m_factor;
    std::vector<double> m_work; ///< one column, dense
};

} // namespace carom::internal
