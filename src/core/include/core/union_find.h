#pragma once

// Who hangs together: union-find over 0 ... size, also by several threads at once. The least of a set is its root, whatever the order of the links.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom::internal {

class UnionFind
{
public:
    /// Each by itself.
    void reset(std::size_t size)
    {
        m_parents.resize(size + 1); // the last is nobody's
        for (std::size_t i = 0; i <= size; ++i)
            m_parents[i] = static_cast<std::int32_t>(i);
    }

    /// Before anything is linked: the later one hangs under the other, whatever it hung under until now. So most links are known by a store each, and
    /// where neighbours have near numbers few sets are left to be linked. Negative: nobody.
    void guess(std::int32_t a, std::int32_t b)
    {
        const std::int32_t under = std::min(a, b);
        const auto nobody = static_cast<std::int32_t>(m_parents.size()) - 1;
        m_parents[static_cast<std::size_t>(under >= 0 ? std::max(a, b) : nobody)] = under; // no branch: it would be guessed wrong
    }

    /// Everyone hangs right under a root.
    void flatten()
    {
        for (std::size_t i = 0; i + 1 < m_parents.size(); ++i)
            m_parents[i] = m_parents[static_cast<std::size_t>(m_parents[i])]; // which comes before it, and is done
    }

    /// False where they hung together already. Negative, of one: nobody. `shared`: other threads link as well.
    bool link(std::int32_t a, std::int32_t b, bool shared)
    {
        a = a >= 0 ? a : b;
        b = b >= 0 ? b : a;
        return above(above(a)) != above(above(b)) && join(a, b, shared); // most hang together already
    }

    /// Whoever hangs together in `other`, which is as large; both have been flattened.
    void join_all(const UnionFind& other)
    {
        for (std::size_t i = 0; i + 1 < other.m_parents.size(); ++i)
        {
            if (m_parents[i] != other.m_parents[i])
                link(static_cast<std::int32_t>(i), other.m_parents[i], false);
        }
    }

    [[nodiscard]] std::int32_t root(std::int32_t i)
    {
        for (;;)
        {
            const std::int32_t up = above(i);
            const std::int32_t beyond = above(up);
            if (beyond == up)
                return up;
            parent(i).store(beyond, std::memory_order_relaxed);
            i = beyond;
        }
    }

    /// One of the same set that comes before it, or itself where none does.
    [[nodiscard]] std::int32_t before(std::size_t i) const { return m_parents[i]; }

private:
    // A parent comes before its children, and only ever gives way to one that comes before it: whatever a thread reads is of the same set.
    std::atomic_ref<std::int32_t> parent(std::int32_t i) { return std::atomic_ref(m_parents[static_cast<std::size_t>(i)]); }
    std::int32_t above(std::int32_t i) { return parent(i).load(std::memory_order_relaxed); }

    bool join(std::int32_t a, std::int32_t b, bool shared)
    {
        for (;;)
        {
            a = root(a);
            b = root(b);
            if (a == b)
                return false;
            if (hang(std::max(a, b), std::min(a, b), shared))
                return true;
        }
    }

    // True if it was a root still.
    bool hang(std::int32_t root, std::int32_t under, bool shared)
    {
        if (shared)
            return parent(root).compare_exchange_strong(root, under, std::memory_order_relaxed);
        parent(root).store(under, std::memory_order_relaxed);
        return true;
    }

    std::vector<std::int32_t> m_parents;
};

} // namespace carom::internal
