#pragma once

// Sorts points of the plane along a Hilbert curve: points that are near in the order are near in the plane, and mostly the reverse.

#include "core/grow.h"
#include "core/task_pool.h"
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

    /// Sorts 0 ... count by where the points at(i) are in their bounding square, 65536 cells a side. Within a cell, indices ascend.
    template <class At>
    void sort(const TaskHooks& tasks, std::size_t count, const At& at)
    {
        const FloatBox around = bounds_of(tasks, count, at);
        const float width = std::fmax(around.ux - around.lx, around.uy - around.ly);
        const float scale = width > 0 ? 65535 / width : 0;
        set_size(m_keys, count);
        for_each_in_chunks(tasks, count, points_per_task,
                           [&](std::size_t i)
                           {
                               const Vec2 p = at(i);
                               const std::uint32_t code = along_curve(cell(p.x, around.lx, scale), cell(p.y, around.ly, scale));
                               m_keys[i] = {code, static_cast<std::uint32_t>(i)};
                           });
        radix_sort();
    }

    [[nodiscard]] std::span<const Key> keys() const { return {m_keys.data(), m_keys.size()}; }

private:
    [[nodiscard]] static std::uint32_t along_curve(std::uint32_t x, std::uint32_t y);

    [[nodiscard]] static std::uint32_t cell(float v, float low, float scale)
    {
        const float g = (v - low) * scale;
        return g > 0 ? static_cast<std::uint32_t>(g < 65535 ? g : 65535) : 0;
    }

    template <class At>
    FloatBox bounds_of(const TaskHooks& tasks, std::size_t count, const At& at)
    {
        FloatBox all;
        for (const FloatBox& some : find_in_chunks(tasks, count, points_per_task, m_bounds,
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

    void radix_sort();

    static constexpr std::size_t points_per_task = 1024;

    std::vector<FloatBox> m_bounds; ///< by chunk
    std::vector<Key> m_keys;
    std::vector<Key> m_other;
};

} // namespace carom::internal
