#pragma once

// Points of the plane along a Hilbert curve: what is near in the order is near in the plane, and mostly the other way round.

#include "core/grow.h"
#include "geometry/bounds.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
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
    void sort(std::size_t count, const At& at)
    {
        FloatBox around;
        for (std::size_t i = 0; i < count; ++i)
        {
            const Vec2 p = at(i);
            around = unite(around, {p.x, p.y, p.x, p.y});
        }
        const float width = std::fmax(around.ux - around.lx, around.uy - around.ly);
        const float scale = width > 0 ? 65535 / width : 0;
        set_size(m_keys, count);
        for (std::size_t i = 0; i < count; ++i)
        {
            const Vec2 p = at(i);
            const std::uint32_t code = along_curve(cell(p.x, around.lx, scale), cell(p.y, around.ly, scale));
            m_keys[i] = {code, static_cast<std::uint32_t>(i)};
        }
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

    // Least significant digit first, 8 bits a pass; stable, so that equal codes keep the order they came in.
    void radix_sort()
    {
        set_size(m_other, m_keys.size());
        for (int shift = 0; shift < 32; shift += 8)
        {
            std::uint32_t counts[257] = {};
            for (const Key& k : m_keys)
                ++counts[((k.code >> shift) & 255u) + 1];
            for (int i = 0; i < 256; ++i)
                counts[i + 1] += counts[i];
            for (const Key& k : m_keys)
                m_other[counts[(k.code >> shift) & 255u]++] = k;
            m_keys.swap(m_other);
        }
    }

    std::vector<Key> m_keys;
    std::vector<Key> m_other;
};

} // namespace carom::internal
