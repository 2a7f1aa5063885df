// Storage of outlines and spans: outlines are shared and reference-counted, and freed ranges are used again.

#include "core/grow.h"
#include "geometry/leaf.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace carom::internal {

namespace {

std::size_t hash_of(std::span<const Vec2> vertices)
{
    std::uint64_t hash = 0;
    for (const Vec2 v : vertices)
        hash = (hash ^ std::bit_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15u;
    return static_cast<std::size_t>(hash >> 56);
}

// Compared bit by bit, so that an outline reads back exactly as it was given: -0 is not 0.
bool is_same(const Vec2* points, std::span<const Vec2> vertices)
{
    return std::memcmp(points, vertices.data(), vertices.size_bytes()) == 0;
}

} // namespace

int LeafStore::allocate(int count)
{
    const auto length = static_cast<std::size_t>(count);
    if (length < m_holes.size() && !m_holes[length].empty())
    {
        const int first = m_holes[length].back();
        m_holes[length].pop_back();
        return first;
    }
    const std::size_t first = m_points.size();
    grow(m_points, first + length);
    grow(m_normals, first + length);
    grow(m_users, first / 3 + 1);
    return static_cast<int>(first);
}

int LeafStore::add_outline(std::span<const Vec2> vertices)
{
    const int count = static_cast<int>(vertices.size());
    Outline& recent = m_recent[hash_of(vertices) % recent_count];
    if (recent.count == count && is_same(points(recent.first), vertices))
    {
        ++users(recent.first);
        return recent.first;
    }
    recent = {allocate(count), count};
    users(recent.first) = 1;
    Vec2* points = m_points.data() + recent.first;
    Vec2* normals = m_normals.data() + recent.first;
    std::copy(vertices.begin(), vertices.end(), points);
    for (int i = 0; i < count; ++i)
        normals[i] = -perp(normalize(points[(i + 1) % count] - points[i]));
    return recent.first;
}

int LeafStore::add_span(const ArcSpan& span) { return m_spans.create(span); }

void LeafStore::release(const Leaf& leaf)
{
    if (leaf.type == LeafType::Arc)
        m_spans.destroy(leaf.first);
    if (leaf.type == LeafType::Polygon && --users(leaf.first) == 0)
        make_hole({leaf.first, leaf.count});
}

void LeafStore::make_hole(const Outline& outline)
{
    const auto length = static_cast<std::size_t>(outline.count);
    Outline& recent = m_recent[hash_of({points(outline.first), length}) % recent_count];
    if (recent == outline)
        recent = {};
    grow(m_holes, length + 1);
    m_holes[length].push_back(outline.first);
}

} // namespace carom::internal
