#include "pinball/player/table_art.h"

#include "carom/error.h"

namespace carom::pinball {

namespace {

// A third of a pixel where the table is 8,000 pixels high.
constexpr float tolerance = 4e-5f;

std::optional<view::OutlineMesh> mesh_of(const view::Path& path)
{
    std::vector<Vec2> outline;
    for (const Position p : path)
        outline.push_back(to_vec2(p));
    try
    {
        return view::OutlineMesh(outline);
    }
    catch (const Error&)
    {
        return std::nullopt;
    }
}

view::Path whole_table(const Table& table) { return {{0, 0}, {table.size.x, 0}, Position(table.size), {0, table.size.y}}; }

} // namespace

TableArt::TableArt(const Table& table) : m_paths(table.elements.size()), m_areas(table.elements.size())
{
    for (Index i = 0; i < table.elements.size(); ++i)
    {
        if (const auto* wall = std::get_if<Wall>(&table.elements[i].part))
            m_paths[i] = view::chain_path(wall->path, tolerance);
        const auto* solid = std::get_if<Solid>(&table.elements[i].part);
        if (solid == nullptr)
            continue;
        m_paths[i] = view::chain_path(solid->path, tolerance);
        m_areas[i] = mesh_of(m_paths[i]);
    }
    m_field = mesh_of(table.outline == none ? whole_table(table) : m_paths[table.outline]);
    if (!m_field)
        m_field = mesh_of(whole_table(table));
}

} // namespace carom::pinball
