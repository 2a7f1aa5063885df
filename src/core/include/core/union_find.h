#pragma once

// Connected sets: union-find over 0 ... size, also by several threads at once. The root of a set is its least element, whatever the order of the links.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace carom::internal {

class UnionFind
{
public:
    /// Makes each element a set of its own.
    void reset(std::size_t size)
    {
        m_parents.resize(size + 1); // the last is a dummy element
        for (std::size_t i = 0; i <= size; ++i)
            m_parents[i] = static_cast<std::int32_t>(i);
    }

    /// Before anything is linked: the later element becomes a child of the other, whatever its parent was. One store each makes most links known, and where
    /// neighbors have near indices few sets are left to be linked. A negative index is no element.
    void guess(std::int32_t a, std::int32_t b)
    {
        const std::int32_t under = std::min(a, b);
        const auto nobody = static_cast<std::int32_t>(m_parents.size()) - 1;
        // Branch-free: the branch would be mispredicted.
        m_parents[static_cast<std::size_t>(under >= 0 ? std::max(a, b) : nobody)] = under;
    }

    /// Makes each element a child of its root. The parents are those of reset and guess.
    void flatten()
    {
        for (std::size_t i = 0; i + 1 < m_parents.size(); ++i)
            m_parents[i] = m_parents[static_cast<std::size_t>(m_parents[i])]; // the parent comes earlier and is done
    }

    /// False where both are in one set already. A negative index is no element. `shared`: other threads link at the same time.
    bool link(std::int32_t a, std::int32_t b, bool shared)
    {
        a = a >= 0 ? a : b;
        b = b >= 0 ? b : a;
        return above(above(a)) != above(above(b)) && join(a, b, shared); // most are in one set already
    }

    /// Joins the elements that are joined in `other`, which has the same size. Both have been flattened.
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

    /// An element of the same set with a lower index, or the element itself where it is the root.
    [[nodiscard]] std::int32_t before(std::size_t i) const { return m_parents[i]; }

private:
    // A parent comes before its children, and is replaced only by an earlier one: whatever a thread reads is of the same set.
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

    // True if `root` was still a root.
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
