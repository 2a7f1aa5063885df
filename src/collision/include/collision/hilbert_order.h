#pragma once

// Points of the plane along a Hilbert curve: what is near in the order is near in the plane, and mostly the other way round.

#include "core/grow.h"
#include "core/task_pool.h"
#include "geometry/bounds.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace carom::internal {

class HilbertOrder
{
public:
    struct Key
    {
        std::uint32_t code;
        std::uint32_t index;
    };

    /// Sorts 0 ... count by where the points at(i) lie in their bounding square, 65536 cells a side; of those in one cell the least comes first.
    template <class At>
    void sort(const TaskHooks& tasks, std::size_t count, const At& at)
    {
        const FloatBox around = bounds_of(tasks, count, at);
        const float width = std::fmax(around.ux - around.lx, around.uy - around.ly);
        const float scale = width > 0 ? 65535 / width : 0;
        set_size(m_keys, count);
        for_each_in_parts(tasks, count, points_per_task,
                          [&](std::size_t i)
                          {
                              const Vec2 p = at(i);
                              const std::uint32_t code = along_curve(cell(p.x, around.lx, scale), cell(p.y, around.ly, scale));
                              m_keys[i] = {code, static_cast<std::uint32_t>(i)};
                          });
        radix_sort();
    }

    [[nodiscard]] std::span<const Key> keys() const { return m_keys; }

private:
    // Each quarter of a square is walked by the same curve, mirrored so that it begins where the one before ends: what two bits say of a place depends on the
    // mirrors that the bits before have put up. Four at a time from a table.
    struct Walk
    {
        std::uint8_t code;
        std::uint8_t mirrors;
    };
    struct WalkTable
    {
        Walk of[4][16][16]; ///< by mirrors, and four bits of x and y

        constexpr WalkTable() : of{}
        {
            for (unsigned mirrors = 0; mirrors < 4; ++mirrors)
            {
                for (unsigned x = 0; x < 16; ++x)
                {
                    for (unsigned y = 0; y < 16; ++y)
                        of[mirrors][x][y] = four_bits(mirrors, x, y);
                }
            }
        }

        static constexpr Walk four_bits(unsigned mirrors, unsigned x, unsigned y)
        {
            bool swapped = (mirrors & 1) != 0;
            bool flipped = (mirrors & 2) != 0;
            unsigned code = 0;
            for (int bit = 3; bit >= 0; --bit)
            {
                const bool is_right = (x >> bit & 1) != 0;
                const bool is_above = (y >> bit & 1) != 0;
                const bool right = (swapped ? is_above : is_right) != flipped;
                const bool above = (swapped ? is_right : is_above) != flipped;
                code = code << 2 | ((right ? 3u : 0u) ^ (above ? 1u : 0u));
                swapped = swapped != !above;
                flipped = flipped != (right && !above);
            }
            return {static_cast<std::uint8_t>(code), static_cast<std::uint8_t>((swapped ? 1u : 0u) | (flipped ? 2u : 0u))};
        }
    };
    [[nodiscard]] static std::uint32_t along_curve(std::uint32_t x, std::uint32_t y)
    {
        static constexpr WalkTable table;
        std::uint32_t code = 0;
        unsigned mirrors = 0;
        for (int shift = 12; shift >= 0; shift -= 4)
        {
            const Walk& walk = table.of[mirrors][x >> shift & 15u][y >> shift & 15u];
            code = code << 8 | walk.code;
            mirrors = walk.mirrors;
        }
        return code;
    }

    [[nodiscard]] static std::uint32_t cell(float v, float low, float scale)
    {
        const float g = (v - low) * scale;
        return g > 0 ? static_cast<std::uint32_t>(g < 65535 ? g : 65535) : 0;
    }

    template <class At>
    FloatBox bounds_of(const TaskHooks& tasks, std::size_t count, const At& at)
    {
        FloatBox all;
        for (const FloatBox& some : find_in_parts(tasks, count, points_per_task, m_bounds,
                                                  [&](std::size_t first, std::size_t last, FloatBox& around)
                                                  {
                                                      around = {};
                                                      for (std::size_t i = first; i < last; ++i)
                                                      {
                                                          const Vec2 p = at(i);
                                                          around = unite(around, {p.x, p.y, p.x, p.y});
                                                      }
                                                  }))
            all = unite(all, some);
        return all;
    }

    // Least significant digit first; stable, so that equal codes keep the order they came in.
    void radix_sort()
    {
        std::uint32_t counts[digits][digit_values] = {};
        for (const Key& k : m_keys)
        {
            for (int d = 0; d < digits; ++d)
                ++counts[d][digit(k, d)];
        }
        set_size(m_other, m_keys.size());
        for (int d = 0; d < digits; ++d)
        {
            std::uint32_t start = 0;
            for (std::uint32_t& count : counts[d])
                start += std::exchange(count, start);
            for (const Key& k : m_keys)
                m_other[counts[d][digit(k, d)]++] = k;
            m_keys.swap(m_other);
        }
    }

    static std::uint32_t digit(const Key& k, int d) { return k.code >> (d * digit_bits) & (digit_values - 1); }

    static constexpr int digit_bits = 11;
    static constexpr int digits = 3;
    static constexpr std::uint32_t digit_values = 1u << digit_bits;
    static constexpr std::size_t points_per_task = 1024;

    std::vector<FloatBox> m_bounds; ///< of parts
    std::vector<Key> m_keys;
    std::vector<Key> m_other;
};

} // namespace carom::internal
