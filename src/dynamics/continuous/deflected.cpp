#include "dynamics/continuous/deflected.h"

#include "core/index.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace carom::internal {

namespace {

constexpr std::size_t few = 16;          // looked at one by one
constexpr std::size_t void_entries = 16; // per flier: from then on the grid is filled anew
constexpr std::int64_t most_cells = 32;

std::int64_t cell_at(double at, double size) { return static_cast<std::int64_t>(std::floor(std::clamp(at / size, -4e15, 4e15))); }

} // namespace

void DeflectedFliers::clear()
{
    m_fliers.clear();
    m_versions.clear();
    m_entries.clear();
    m_heads.clear();
    m_wide.clear();
}

std::int32_t DeflectedFliers::add(std::int32_t flier)
{
    m_fliers.push_back(flier);
    m_versions.push_back(0);
    return static_cast<std::int32_t>(m_fliers.size()) - 1;
}

void DeflectedFliers::set_all(double end, std::span<const Reach> reaches)
{
    m_end = end;
    fill_grid(reaches);
}

void DeflectedFliers::set(std::int32_t index, std::span<const Reach> reaches)
{
    if (m_heads.empty() || m_entries.size() > void_entries * m_fliers.size())
    {
        fill_grid(reaches);
        return;
    }
    ++m_versions[as_index(index)];
    enter(index, reaches[as_index(m_fliers[as_index(index)])]);
}

// Cells are about as large as what they hold.
void DeflectedFliers::fill_grid(std::span<const Reach> reaches)
{
    m_entries.clear();
    m_heads.clear();
    m_wide.clear();
    if (m_fliers.size() <= few)
        return;
    double sum = 0;
    for (const std::int32_t flier : m_fliers)
    {
        const Reach& reach = reaches[as_index(flier)];
        sum += 2 * reach.radius + (m_end - reach.time) * std::sqrt(reach.vx * reach.vx + reach.vy * reach.vy);
    }
    m_cell = std::max(sum / static_cast<double>(m_fliers.size()), 1e-300);
    m_heads.assign(std::bit_ceil(8 * m_fliers.size()), -1);
    for (std::size_t i = 0; i < m_fliers.size(); ++i)
        enter(static_cast<std::int32_t>(i), reaches[as_index(m_fliers[i])]);
}

bool DeflectedFliers::Cells::are_many() const { return (x1 - x0 + 1) > most_cells || (y1 - y0 + 1) * (x1 - x0 + 1) > most_cells; }

DeflectedFliers::Cells DeflectedFliers::cells_of(const Reach& reach) const
{
    const double left = std::max(m_end - reach.time, 0.0);
    const double x = reach.x + left * reach.vx;
    const double y = reach.y + left * reach.vy;
    const double r = reach.radius;
    return {cell_at(std::min(reach.x, x) - r, m_cell), cell_at(std::min(reach.y, y) - r, m_cell),
            cell_at(std::max(reach.x, x) + r, m_cell), cell_at(std::max(reach.y, y) + r, m_cell)};
}

std::size_t DeflectedFliers::slot_of(std::int64_t x, std::int64_t y) const
{
    const std::uint64_t key =
        static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u ^ static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu;
    return static_cast<std::size_t>(key >> 20) & (m_heads.size() - 1);
}

void DeflectedFliers::enter(std::int32_t index, const Reach& reach)
{
    const Cells cells = cells_of(reach);
    if (cells.are_many())
    {
        if (std::ranges::find(m_wide, index) == m_wide.end())
            m_wide.push_back(index);
        return;
    }
    for (std::int64_t y = cells.y0; y <= cells.y1; ++y)
    {
        for (std::int64_t x = cells.x0; x <= cells.x1; ++x)
        {
            std::int32_t& head = m_heads[slot_of(x, y)];
            m_entries.push_back({index, m_versions[as_index(index)], head, cells.x0, cells.y0});
            head = static_cast<std::int32_t>(m_entries.size()) - 1;
        }
    }
}

std::size_t DeflectedFliers::find_near(const Reach& own, std::span<std::int32_t> found) const
{
    constexpr std::size_t too_many = most_found + 1;
    std::size_t count = 0;
    const auto note = [&](std::int32_t index)
    {
        if (count < most_found)
            found[count] = m_fliers[as_index(index)];
        ++count;
    };
    if (m_heads.empty())
    {
        for (std::size_t i = 0; i < m_fliers.size(); ++i)
            note(static_cast<std::int32_t>(i));
    }
    else
    {
        const Cells cells = cells_of(own);
        if (cells.are_many())
            return too_many;
        for (std::int64_t y = cells.y0; y <= cells.y1; ++y)
        {
            for (std::int64_t x = cells.x0; x <= cells.x1; ++x)
            {
                for (std::int32_t e = m_heads[slot_of(x, y)]; e >= 0; e = m_entries[as_index(e)].next)
                {
                    const Entry& entry = m_entries[as_index(e)];
                    const bool is_first_common = x == std::max(entry.x0, cells.x0) && y == std::max(entry.y0, cells.y0);
                    if (is_first_common && entry.version == m_versions[as_index(entry.index)])
                        note(entry.index);
                }
            }
        }
        for (const std::int32_t index : m_wide)
            note(index);
    }
    if (count > most_found)
        return too_many;
    const auto end = found.begin() + static_cast<std::ptrdiff_t>(count);
    std::sort(found.begin(), end);
    return static_cast<std::size_t>(std::unique(found.begin(), end) - found.begin());
}

} // namespace carom::internal
