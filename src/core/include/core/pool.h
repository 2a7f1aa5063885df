#pragma once

// Objects in numbered slots: a plain array, generations, and a free list, so that a copy of a pool is a copy of memory in which
// ids stay valid. A slot's generation is odd while it is alive.

#include "core/assert.h"
#include "core/grow.h"

#include <cstdint>
#include <type_traits>
#include <vector>

namespace carom::internal {

template <class T, Growth growth = Growth::Quarter>
class Pool
{
    static_assert(std::is_trivially_copyable_v<T>, "simulation state is copied as memory");

public:
    int create(const T& value)
    {
        const int slot = take();
        m_items[static_cast<std::size_t>(slot)] = value;
        return slot;
    }

    /// Takes a slot without clearing it: it may still hold its last object.
    int take()
    {
        int slot;
        if (m_free.empty())
        {
            slot = static_cast<int>(m_items.size());
            append<growth>(m_items, T());
            append<growth>(m_generations, 1);
        }
        else
        {
            slot = m_free.back();
            m_free.pop_back();
            ++m_generations[static_cast<std::size_t>(slot)];
        }
        ++m_count;
        return slot;
    }

    void destroy(int slot)
    {
        CAROM_ASSERT(is_live(slot), "a slot is destroyed once");
        ++m_generations[static_cast<std::size_t>(slot)];
        m_free.push_back(slot);
        --m_count;
    }

    /// Destroys the object in a slot and takes the slot again at once.
    void renew(int slot)
    {
        CAROM_ASSERT(is_live(slot), "what is destroyed is there");
        m_generations[static_cast<std::size_t>(slot)] += 2;
    }

    [[nodiscard]] bool is_live(int slot) const
    {
        return slot >= 0 && slot < capacity() && (m_generations[static_cast<std::size_t>(slot)] & 1u) != 0;
    }
    [[nodiscard]] bool is_live(int slot, std::uint32_t generation) const
    {
        return is_live(slot) && m_generations[static_cast<std::size_t>(slot)] == generation;
    }
    [[nodiscard]] const std::uint32_t& generation(int slot) const { return m_generations[static_cast<std::size_t>(slot)]; }
    [[nodiscard]] int count() const { return m_count; }
    [[nodiscard]] int capacity() const { return static_cast<int>(m_items.size()); }

    T& operator[](int slot) { return m_items[static_cast<std::size_t>(slot)]; }
    const T& operator[](int slot) const { return m_items[static_cast<std::size_t>(slot)]; }

private:
    std::vector<T> m_items;
    std::vector<std::uint32_t> m_generations;
    std::vector<int> m_free;
    int m_count = 0;
};

} // namespace carom::internal
