#pragma once

// The held rows of one joint, solved as one block: K = J M^-1 J^T = L D L^T, at most 3 x 3.

#include "dynamics/state/scene_state.h"

#include <cstddef>

namespace carom::internal {

class HeldBlock
{
public:
    /// `couple(i, j)` is the entry of K, for j <= i.
    template <class Couple>
    HeldBlock(std::size_t count, Couple&& couple);
    /// x = K^-1 x. A row that earlier rows imply gets 0.
    void solve(float (&x)[most_joint_rows]) const;

private:
    static constexpr float least_rest = 1e-6f; ///< of a diagonal entry, once the earlier rows are eliminated

    std::size_t m_count;
    float m_lower[most_joint_rows][most_joint_rows] = {}; ///< L D below the diagonal
    float m_inverse_d[most_joint_rows] = {};
};

template <class Couple>
HeldBlock::HeldBlock(std::size_t count, Couple&& couple) : m_count(count)
{
    for (std::size_t i = 0; i < count; ++i)
    {
        const float diagonal = couple(i, i);
        float rest = diagonal;
        for (std::size_t j = 0; j < i; ++j)
        {
            float entry = couple(i, j);
            for (std::size_t k = 0; k < j; ++k)
                entry -= m_lower[i][k] * m_inverse_d[k] * m_lower[j][k];
            m_lower[i][j] = entry;
            rest -= entry * m_inverse_d[j] * entry;
        }
        m_inverse_d[i] = rest > least_rest * diagonal ? 1 / rest : 0;
    }
}

inline void HeldBlock::solve(float (&x)[most_joint_rows]) const
{
    for (std::size_t i = 0; i < m_count; ++i)
    {
        for (std::size_t j = 0; j < i; ++j)
            x[i] -= m_lower[i][j] * m_inverse_d[j] * x[j];
    }
    for (std::size_t i = m_count; i-- > 0;)
    {
        x[i] *= m_inverse_d[i];
        for (std::size_t j = i + 1; j < m_count; ++j)
            x[i] -= m_inverse_d[i] * m_lower[j][i] * x[j];
    }
}

} // namespace carom::internal
