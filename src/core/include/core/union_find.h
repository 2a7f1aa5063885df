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
        m_parents.resize(size);
        for (std::size_t i = 0; i < size; ++i)
            m_parents[i] = static_cast<std::int32_t>(i);
    }

    /// False where they hung together already. `shared`: other threads link as well.
    bool link(std::int32_t a, std::int32_t b, bool shared)
    {
        return above(a) != above(b) && join(a, b, shared); // most hang together already
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
