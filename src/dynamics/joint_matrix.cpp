// A = J M^-1 J^T by blocks of two rows, a block row for each joint. Joints i and k couple where they share a body p that moves:
//
//   A_ki = J_kp M_p^-1 J_ip^T;   A_ii is the sum of that over both bodies of i
//
// In the order of the forest (joint_forest.h) a joint couples with its parent and its siblings before it, and with children after it. Eliminated
// from the last joint to the first, it therefore changes only blocks between its parent and siblings, which are there already: they all share
// the same body. With D_i the block on the diagonal when it is the turn of i, and u, v neighbors of i that come before it,
//
//   W_ui = A_ui D_i^-1,   A_uv -= W_ui A_vi^T,   so that A = W D W^T with W upper triangular
//
// A chain costs what it is long; a body with k joints costs k³ / 6 blocks. All of it in double.

#include "dynamics/joint_matrix.h"

namespace carom::internal {

namespace {

constexpr double least_rest = 1e-10; // of a diagonal entry, once what comes before is taken out

// J M^-1 J'^T of two rows at one body.
double couple(const Triple& row, const Triple& mass, const Triple& other) { return dot(product(row, mass), other); }

} // namespace

void JointMatrix::lay_out(std::span<const JointForest::Joint> joints)
{
    m_neighbors.clear();
    int blocks = 0;
    for (std::size_t i = 0; i < joints.size(); ++i)
    {
        const JointForest::Joint& j = joints[i];
        const int parents = j.parent < 0 ? 0 : 1;
        const int siblings = static_cast<int>(i) - j.first_sibling;
        m_neighbors.push_back({parents, j.parent, j.first_sibling, parents + siblings, blocks});
        blocks += parents + siblings;
    }
    m_pivots.resize(joints.size());
    m_blocks.resize(static_cast<std::size_t>(blocks));
}

bool JointMatrix::factor(std::span<const JointForest::Joint> joints, std::span<const JointJacobian> jacobians,
                         std::span<const Triple> masses)
{
    fill(joints, jacobians, masses);
    for (std::size_t i = m_pivots.size(); i-- > 0;)
    {
        if (!m_pivots[i].factor())
            return false;
        eliminate(m_neighbors[i], m_pivots[i]);
    }
    return true;
}

void JointMatrix::fill(std::span<const JointForest::Joint> joints, std::span<const JointJacobian> jacobians,
                       std::span<const Triple> masses)
{
    for (std::size_t i = 0; i < joints.size(); ++i)
    {
        const JointJacobian& own = jacobians[i];
        const Triple& up = masses[static_cast<std::size_t>(joints[i].up)];
        const Triple& down = masses[static_cast<std::size_t>(joints[i].down)];
        const auto entry = [&](int r, int c)
        { return couple(own.up[r], up, own.up[c]) + couple(own.down[r], down, own.down[c]); };
        Pivot& p = m_pivots[i];
        p.xx = entry(0, 0);
        p.xy = own.rows == 2 ? entry(0, 1) : 0;
        p.yy = own.rows == 2 ? entry(1, 1) : 1;
        p.least_xx = least_rest * p.xx;
        p.least_yy = least_rest * p.yy;
        const Neighbors& n = m_neighbors[i];
        const Triple by[2] = {product(own.up[0], up), product(own.up[1], up)};
        for (int k = 0; k < n.count; ++k)
        {
            const JointJacobian& other = jacobians[static_cast<std::size_t>(n.joint(k))];
            const Triple(&rows)[2] = k < n.parents ? other.down : other.up;
            block(n.first_block + k) = {{dot(rows[0], by[0]), dot(rows[0], by[1])}, {dot(rows[1], by[0]), dot(rows[1], by[1])}};
        }
    }
}

bool JointMatrix::Pivot::factor()
{
    if (!(xx > least_xx))
        return false;
    inverse_x = 1 / xx;
    l = xy * inverse_x;
    const double rest = yy - l * xy;
    if (!(rest > least_yy))
        return false;
    inverse_y = 1 / rest;
    return true;
}

RowPair JointMatrix::Pivot::solve(const RowPair& v) const
{
    const double y = (v.y - l * v.x) * inverse_y;
    return {v.x * inverse_x - l * y, y};
}

// Siblings have the same neighbors in the same places.
void JointMatrix::eliminate(const Neighbors& n, const Pivot& by)
{
    for (int u = n.count - 1; u >= 0; --u)
    {
        Block& own = block(n.first_block + u);
        const Block w = {by.solve(own.x), by.solve(own.y)};
        Pivot& diagonal = pivot(n.joint(u));
        diagonal.xx -= dot(w.x, own.x);
        diagonal.xy -= dot(w.x, own.y);
        diagonal.yy -= dot(w.y, own.y);
        if (u >= n.parents)
        {
            const int first = m_neighbors[static_cast<std::size_t>(n.joint(u))].first_block;
            for (int v = 0; v < u; ++v)
            {
                const Block& other = block(n.first_block + v);
                // Block (v, u): rows of v, columns of u.
                Block& changed = block(first + v);
                changed.x.x -= dot(other.x, w.x);
                changed.x.y -= dot(other.x, w.y);
                changed.y.x -= dot(other.y, w.x);
                changed.y.y -= dot(other.y, w.y);
            }
        }
        own = w;
    }
}

void JointMatrix::solve(std::span<RowPair> values) const
{
    for (std::size_t i = values.size(); i-- > 0;)
    {
        const Neighbors& n = m_neighbors[i];
        const RowPair own = values[i];
        for (int k = 0; k < n.count; ++k)
        {
            const Block& w = block(n.first_block + k);
            RowPair& other = values[static_cast<std::size_t>(n.joint(k))];
            other.x -= dot(w.x, own);
            other.y -= dot(w.y, own);
        }
        values[i] = m_pivots[i].solve(own);
    }
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        const Neighbors& n = m_neighbors[i];
        RowPair& own = values[i];
        for (int k = 0; k < n.count; ++k)
        {
            const Block& w = block(n.first_block + k);
            const RowPair& other = values[static_cast<std::size_t>(n.joint(k))];
            own.x -= w.x.x * other.x + w.y.x * other.y;
            own.y -= w.x.y * other.x + w.y.y * other.y;
        }
    }
}

} // namespace carom::internal
