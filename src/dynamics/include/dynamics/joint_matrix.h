#pragma once

// The system of equations of what joints hold: A = J M^-1 J^T, how the impulse of one row changes the speed along another. See joint_matrix.cpp.

#include "dynamics/joint_forest.h"

#include <span>
#include <vector>

namespace carom::internal {

/// Of the two rows of a joint. Where it holds only one, the second is 0 throughout.
struct RowPair
{
    double x = 0;
    double y = 0;
};

/// Of a body: along its two coordinates and its angle.
struct Triple
{
    double x = 0;
    double y = 0;
    double turn = 0;

    friend bool operator==(const Triple&, const Triple&) = default;
};

[[nodiscard]] constexpr double dot(const RowPair& a, const RowPair& b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] constexpr double dot(const Triple& a, const Triple& b) { return a.x * b.x + a.y * b.y + a.turn * b.turn; }
[[nodiscard]] constexpr Triple product(const Triple& a, const Triple& b) { return {a.x * b.x, a.y * b.y, a.turn * b.turn}; }

/// A joint's part of J, by row: at the body towards the root and at the one that hangs on it.
struct JointJacobian
{
    Triple up[2];
    Triple down[2];
    int rows = 0;
};

class JointMatrix
{
public:
    /// Once for a forest.
    void lay_out(std::span<const JointForest::Joint> joints);
    /// Masses are inverse and by node. False where rows say the same thing twice.
    [[nodiscard]] bool factor(std::span<const JointForest::Joint> joints, std::span<const JointJacobian> jacobians,
                              std::span<const Triple> masses);
    /// A^-1 values, in place.
    void solve(std::span<RowPair> values) const;

private:
    struct Block
    {
        RowPair x; ///< its rows
        RowPair y;
    };

    /// A block of the diagonal; factored, it is [1 0; l 1] diag(1 / inverse_x, 1 / inverse_y) [1 l; 0 1].
    struct Pivot
    {
        double xx = 0;
        double xy = 0;
        double yy = 0;
        double least_xx = 0; ///< what must be left of it
        double least_yy = 0;
        double l = 0;
        double inverse_x = 0;
        double inverse_y = 0;

        [[nodiscard]] bool factor();
        [[nodiscard]] RowPair solve(const RowPair& v) const;
    };

    /// The joints before this one that it couples with: the parent, then the siblings.
    struct Neighbors
    {
        int parents = 0; ///< 0 or 1
        int parent = 0;
        int first_sibling = 0;
        int count = 0;
        int first_block = 0;

        [[nodiscard]] int joint(int i) const { return i < parents ? parent : first_sibling + i - parents; }
    };

    void fill(std::span<const JointForest::Joint> joints, std::span<const JointJacobian> jacobians,
              std::span<const Triple> masses);
    void eliminate(const Neighbors& neighbors, const Pivot& pivot);
    [[nodiscard]] Block& block(int i) { return m_blocks[static_cast<std::size_t>(i)]; }
    [[nodiscard]] const Block& block(int i) const { return m_blocks[static_cast<std::size_t>(i)]; }
    [[nodiscard]] Pivot& pivot(int joint) { return m_pivots[static_cast<std::size_t>(joint)]; }

    std::vector<Neighbors> m_neighbors; ///< by joint
    std::vector<Pivot> m_pivots;        ///< by joint
    std::vector<Block> m_blocks;        ///< rows of the neighbor, columns of the joint
};

} // namespace carom::internal
