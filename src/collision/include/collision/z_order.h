#pragma once

// Points of the plane along a Z-curve (Morton codes): what is near in the plane is mostly near in the order.

#include "geometry/bounds.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

class ZOrder
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
        m_keys.resize(count);
        for (std::size_t i = 0; i < count; ++i)
        {
            const Vec2 p = at(i);
            const std::uint32_t code = spread(cell(p.x, around.lx, scale)) | (spread(cell(p.y, around.ly, scale)) << 1);
            m_keys[i] = {code, static_cast<std::uint32_t>(i)};
        }
        radix_sort();
    }

    [[nodiscard]] std::span<const Key> keys() const { return m_keys; }

private:
    // 16 bits to the even places.
    [[nodiscard]] static std::uint32_t spread(std::uint32_t x)
    {
        x = (x | (x << 8)) & 0x00ff00ffu;
        x = (x | (x << 4)) & 0x0f0f0f0fu;
        x = (x | (x << 2)) & 0x33333333u;
        return (x | (x << 1)) & 0x55555555u;
    }

    [[nodiscard]] static std::uint32_t cell(float v, float low, float scale)
    {
        const float g = (v - low) * scale;
        return g > 0 ? static_cast<std::uint32_t>(g < 65535 ? g : 65535) : 0;
    }

    // Least significant digit first, 8 bits a pass; stable, so that equal codes keep the order they came in.
    void radix_sort()
    {
        m_other.resize(m_keys.size());
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
