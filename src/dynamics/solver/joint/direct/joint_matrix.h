#pragma once

// The system of equations of an island's joints: A = J M^-1 J^T + C, how the impulse of one row changes the speed along another. C is the compliance
// of the rows. See joint_matrix.cpp.

#include <limits>
#include <span>
#include <vector>

namespace carom::internal {

/// Of a body: along its two coordinates and its angle.
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

constexpr int most_joint_rows = 3;

/// A joint's part of J, by row.
struct JointJacobian
{
    Triple a[most_joint_rows];
    Triple b[most_joint_rows];
    double arm_a = 0; ///< squared, of the anchors
    double arm_b = 0;
};

class JointMatrix
{
public:
    static constexpr int ground = 0;                                       ///< the node of all that does not move
    static constexpr double off = std::numeric_limits<double>::infinity(); ///< compliance of a row that gives no impulse

    /// An edge of the constraint graph, whose nodes are bodies.
    struct Edge
    {
        int a = ground;
        int b = ground;
        int rows = 0;
    };

    /// Once for a graph, with or without loops: the order of elimination, and where the factor has entries.
    void lay_out(std::span<const Edge> edges, int nodes);
    [[nodiscard]] int rows() const { return static_cast<int>(m_diagonal.size()); }
    /// The rows of an edge follow one another.
    [[nodiscard]] int first_row(std::size_t edge) const { return m_first_row[edge]; }
    [[nodiscard]] bool has_loops() const { return m_has_loops; }

    /// The inverse mass of a row's two bodies along it, or inertia, that compliances are measured by. A body that may only turn has that of the anchor.
    [[nodiscard]] double weight(int row) const { return m_weights[static_cast<std::size_t>(row)]; }

    /// J M^-1 J^T. Jacobians by edge; masses are inverse and by node.
    void fill(std::span<const JointJacobian> jacobians, std::span<const Triple> masses);
    /// With a compliance for each row, and one that all have in proportion to their weights. A row that the rows before it imply gives no impulse.
    void factor(std::span<const double> compliances, double of_all = 0);
    /// A^-1 values, in place.
    void solve(std::span<double> values) const;
    /// The same for three columns of values, and for rows, in order, that no other row depends on; the other values are left alone.
    void solve(std::span<Triple> values, std::span<const int> rows) const;

private:
    /// Two edges that share a body that moves.
    struct Coupling
    {
        int first = 0; ///< edge that is eliminated first
        int second = 0;
        int node = ground;
        bool first_by_a = false; ///< its body a is the one
        bool second_by_a = false;
        int entries[most_joint_rows] = {}; ///< where the rows of the second begin in each column of the first
    };

    /// An entry of the factor, by its row.
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
    std::vector<int> m_order;     ///< edges as they are eliminated
    std::vector<int> m_first_row; ///< by edge
    bool m_has_loops = false;

    std::vector<int> m_column_starts; ///< entries below the diagonal, by column
    std::vector<int> m_rows;          ///< of the entries
    std::vector<int> m_hit_starts;    ///< by row
    std::vector<Hit> m_hits;
    std::vector<double> m_diagonal; ///< of A
    std::vector<double> m_weights;
    std::vector<double> m_entries;
    std::vector<double> m_pivots; ///< of the factor, inverse
    std::vector<double> m_factor;
    std::vector<double> m_work; ///< a column in full
};

} // namespace carom::internal
