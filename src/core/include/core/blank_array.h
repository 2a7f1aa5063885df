#pragma once

// Room for items that are written before they are read. It grows without copying or touching anything: the first to write an item pays for its page, and where
// threads write side by side they share that.

#include <cstddef>
#include <memory>
#include <type_traits>

namespace carom::internal {

template <class T>
class BlankArray
{
    static_assert(std::is_trivial_v<T>);

public:
    /// Room for `size` items in all; where there was not enough, what they held is lost. Grows by a quarter at least.
    void make_room(std::size_t size)
    {
        if (size <= m_size)
            return;
        const std::size_t wanted = m_size + m_size / 4;
        m_size = size > wanted ? size : wanted;
        m_items.reset(); // before there are both
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
