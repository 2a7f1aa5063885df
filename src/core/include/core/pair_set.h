#pragma once

// A set of unordered index pairs: open addressing over 64-bit keys, linear probing, backward-shift deletion. It is only queried, and
// iterated only to erase or to hash, so that its order cannot leak into the simulation.

#include "core/hash.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace carom::internal {

[[nodiscard]] constexpr std::uint64_t pair_key(int a, int b)
{
    const auto low = static_cast<std::uint64_t>(static_cast<std::uint32_t>(a < b ? a : b));
    const auto high = static_cast<std::uint64_t>(static_cast<std::uint32_t>(a < b ? b : a));
    return (high << 32) | low;
}

[[nodiscard]] constexpr bool is_in_pair(std::uint64_t key, int a)
{
    const auto index = static_cast<std::uint32_t>(a);
    return static_cast<std::uint32_t>(key) == index || static_cast<std::uint32_t>(key >> 32) == index;
}

class PairSet
{
public:
    [[nodiscard]] bool empty() const { return m_count == 0; }
    /// Hash of the set, independent of the order of insertions.
    [[nodiscard]] std::uint64_t hash() const
    {
        std::uint64_t sum = 0;
        for (const std::uint64_t key : m_keys)
            sum += key == vacant ? 0 : mix_bits(key + 1);
        return sum;
    }
    [[nodiscard]] bool contains(std::uint64_t key) const { return m_count > 0 && m_keys[find(key)] == key; }

    /// True when the key was not there before.
    bool insert(std::uint64_t key)
    {
        if (static_cast<std::size_t>(m_count + 1) * 2 > m_keys.size())
            grow();
        const std::size_t i = find(key);
        if (m_keys[i] == key)
            return false;
        m_keys[i] = key;
        ++m_count;
        return true;
    }

    void erase(std::uint64_t key)
    {
        if (!contains(key))
            return;
        std::size_t hole = find(key);
        const std::size_t mask = m_keys.size() - 1;
        for (std::size_t i = (hole + 1) & mask; m_keys[i] != vacant; i = (i + 1) & mask)
        {
            const std::size_t home = home_of(m_keys[i]);
            if (((i - home) & mask) >= ((i - hole) & mask))
            {
                m_keys[hole] = m_keys[i];
                hole = i;
            }
        }
        m_keys[hole] = vacant;
        --m_count;
    }

    template <class Predicate>
    void erase_if(const Predicate& predicate)
    {
        std::vector<std::uint64_t> keys;
        std::copy_if(m_keys.begin(), m_keys.end(), std::back_inserter(keys),
                     [&](std::uint64_t key) { return key != vacant && predicate(key); });
        for (const std::uint64_t key : keys)
            erase(key);
    }

private:
    static constexpr std::uint64_t vacant = ~std::uint64_t{0};

    [[nodiscard]] std::size_t home_of(std::uint64_t key) const { return mix_bits(key) & (m_keys.size() - 1); }

    [[nodiscard]] std::size_t find(std::uint64_t key) const
    {
        std::size_t i = home_of(key);
        while (m_keys[i] != vacant && m_keys[i] != key)
            i = (i + 1) & (m_keys.size() - 1);
        return i;
    }

    void grow()
    {
        std::vector<std::uint64_t> old(m_keys.empty() ? 16 : m_keys.size() * 2, vacant);
        old.swap(m_keys);
        for (std::uint64_t key : old)
        {
            if (key != vacant)
                m_keys[find(key)] = key;
        }
    }

    std::vector<std::uint64_t> m_keys;
    int m_count = 0;
};

} // namespace carom::internal
