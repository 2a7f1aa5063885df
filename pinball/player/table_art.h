#pragma once

/// @file
/// Outlines of the table that do not move, made once.

#include "pinball/table/table.h"
#include "view/canvas.h"

#include <optional>
#include <vector>

namespace carom::pinball {

class TableArt
{
public:
    explicit TableArt(const Table& table);

    /// Middle line of a wall, outline of a solid, else empty.
    [[nodiscard]] const view::Path& path(Index element) const { return m_paths[element]; }
    /// Area of a solid; null where its outline cannot be filled.
    [[nodiscard]] const view::OutlineMesh* area(Index element) const { return m_areas[element] ? &*m_areas[element] : nullptr; }
    /// Where balls can be.
    [[nodiscard]] const view::OutlineMesh* field() const { return m_field ? &*m_field : nullptr; }

private:
    std::vector<view::Path> m_paths;
    std::vector<std::optional<view::OutlineMesh>> m_areas;
    std::optional<view::OutlineMesh> m_field{};
};

} // namespace carom::pinball
