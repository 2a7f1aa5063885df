#pragma once

// An array for items that are written before they are read. It grows without copying or touching memory: the first write to an item pays for its page, and
// threads that write concurrently share that cost.

#include <cstddef>
#include <memory>
#include <type_traits>

namespace carom::internal {

template <class T>
class BlankArray
{
    static_assert(std::is_trivial_v<T>);

public:
    /// Room for `size` items in all. Where there was not enough, the old items are lost. Grows by at least a quarter.
    void make_room(std::size_t size)
    {
        if (size <= m_size)
            return;
        const std::size_t wanted = m_size + m_size / 4;
        m_size = size > wanted ? size : wanted;
        m_items.reset(); // frees the old items before the new ones are allocated
        m_items = std::make_unique_for_overwrite<T[]>(m_size);
    }

    [[nodiscard]] std::size_t size() const { return m_size; }
    [[nodiscard]] T* data() { return m_items.get(); }
    [[nodiscard]] T& operator[](std::size_t i) { return m_items[i]; }

private:
    std::unique_ptr<T[]> m_items;
    std::size_t m_size = 0;
};

} // namespace carom::internal
