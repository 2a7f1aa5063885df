#pragma once

// A leaf is a shape as collision sees it: plain data in its body's frame. A chain becomes several leaves; every other public
// shape becomes one. Vertices of polygons and spans of arcs are in a separate store, so that leaves stay plain and small.

#include "carom/math.h"
#include "carom/shape.h"
#include "core/pool.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

/// The order is that of the collision table.
enum class LeafType : std::uint8_t
{
    HalfSpace,
    Circle,
    Polygon,
    Capsule,
    Segment,
    Arc,
};
inline constexpr int leaf_type_count = 6;

struct Leaf
{
    LeafType type = LeafType::Circle;
    Sides sides = Sides::Both;
    bool has_previous = false; ///< whether the seam at the start is shared with the previous piece
    bool has_next = false;
    std::int32_t first = 0; ///< index in the store. Polygon: its vertices are [first, first + count). Arc: its span
    std::int32_t count = 0;
    /// Circle: p0 center, r0 radius. Capsule: circles (p0, r0), (p1, r1). Segment: from p0 to p1, r0 = r1 half thickness.
    /// Half-space: p0 normal, r0 offset. Polygon: r0 corner radius. Arc: p0 center, r0 half thickness, p1 unit direction of its middle.
    Vec2 p0{};
    Vec2 p1{};
    float r0 = 0;
    float r1 = 0;
    float arc_radius = 0;
    Vec2 previous_tangent{}; ///< direction in which the previous piece arrives at the start
    Vec2 next_tangent{};     ///< direction in which the next piece leaves the end
};

/// Whether the leaf is a piece with neighbors, or solid on one side only.
[[nodiscard]] inline bool is_of_chain(const Leaf& leaf)
{
    return leaf.has_previous || leaf.has_next || leaf.sides != Sides::Both;
}

/// Whether a point at this distance to the left of a piece faces a side that is not solid.
[[nodiscard]] inline bool is_beside_solid_side(const Leaf& piece, double left)
{
    return (piece.sides == Sides::Left && left < 0) || (piece.sides == Sides::Right && left > 0);
}

/// Whether the center of a body, in the leaf's frame, is on the left of a straight piece along the chain's course. On the convex side of a seam it is
/// on the left if it is so for either of the two pieces; on the hollow side, if it is so for both.
template <class R>
[[nodiscard]] bool is_left_of_chain(const Leaf& piece, R x, R y)
{
    const auto turns = [](Vec2 tangent, R dx, R dy) { return static_cast<R>(tangent.x) * dy - static_cast<R>(tangent.y) * dx; };
    const Vec2 own = piece.p1 - piece.p0;
    const R from_start_x = x - static_cast<R>(piece.p0.x);
    const R from_start_y = y - static_cast<R>(piece.p0.y);
    bool left = turns(own, from_start_x, from_start_y) > 0;
    const auto at_seam = [&](Vec2 tangent, float bend, R dx, R dy)
    {
        const bool before_neighbour = turns(tangent, dx, dy) > 0;
        left = bend < 0 ? left || before_neighbour : left && before_neighbour;
    };
    if (piece.has_previous)
        at_seam(piece.previous_tangent, cross(piece.previous_tangent, own), from_start_x, from_start_y);
    if (piece.has_next)
        at_seam(piece.next_tangent, cross(own, piece.next_tangent), x - static_cast<R>(piece.p1.x),
                y - static_cast<R>(piece.p1.y));
    return left;
}

/// Angles and end points of an arc about its center.
struct ArcSpan
{
    float start_angle = 0;
    float sweep = 0;
    float cos_half_sweep = 0;
    Vec2 start{};
    Vec2 end{};
};

/// Outlines of all polygons of a scene, and spans of its arcs. An outline is its vertices and its outward edge normals (edge i runs from vertex i to i + 1).
/// Polygons with equal vertices, as most bodies of a pile have, share one outline, which stays in the cache.
class LeafStore
{
public:
    /// Index of the first vertex of an outline. A recently given convex outline that is the same bit by bit is shared; otherwise a new one is stored.
    [[nodiscard]] int add_outline(std::span<const Vec2> vertices);
    [[nodiscard]] int add_span(const ArcSpan& span);
    /// Frees what the leaf uses in the store.
    void release(const Leaf& leaf);

    [[nodiscard]] const Vec2* points(int first) const { return m_points.data() + first; }
    [[nodiscard]] const Vec2* normals(int first) const { return m_normals.data() + first; }
    [[nodiscard]] const ArcSpan& span(int place) const { return m_spans[place]; }

private:
    static constexpr std::size_t recent_count = 64;

    struct Outline
    {
        std::int32_t first = 0;
        std::int32_t count = 0; ///< 0: none
        friend bool operator==(const Outline&, const Outline&) = default;
    };

    [[nodiscard]] int allocate(int count);
    void make_hole(const Outline& outline);
    [[nodiscard]] std::int32_t& users(int first) { return m_users[static_cast<std::size_t>(first / 3)]; }

    std::vector<Vec2> m_points;
    std::vector<Vec2> m_normals;
    std::vector<std::int32_t>
        m_users; ///< number of leaves with the outline at `first`, by first / 3, since no outline is shorter
    std::vector<std::vector<std::int32_t>> m_holes; ///< first vertices of free ranges, by their length
    std::array<Outline, recent_count> m_recent{};   ///< by the hash of their vertices
    Pool<ArcSpan> m_spans;
};

/// A leaf with pointers to its data in the store.
struct LeafView
{
    const Leaf* leaf;
    const Vec2* points = nullptr; ///< for a polygon
    const Vec2* normals = nullptr;
    const ArcSpan* span = nullptr; ///< for an arc
};

[[nodiscard]] inline LeafView view(const Leaf& leaf, const LeafStore& store)
{
    if (leaf.type == LeafType::Polygon)
        return {&leaf, store.points(leaf.first), store.normals(leaf.first)};
    if (leaf.type == LeafType::Arc)
        return {&leaf, nullptr, nullptr, &store.span(leaf.first)};
    return {&leaf};
}

/// Unit direction of an arc or segment at its start and end, along its course.
[[nodiscard]] Vec2 start_tangent(const LeafView& view);
[[nodiscard]] Vec2 end_tangent(const LeafView& view);
[[nodiscard]] Vec2 start_point(const LeafView& view);
[[nodiscard]] Vec2 end_point(const LeafView& view);

/// Whether an arc has a point in this direction from its center.
[[nodiscard]] inline bool is_in_sweep(const LeafView& arc, Vec2 from_center)
{
    return dot(from_center, arc.leaf->p1) >= length(from_center) * arc.span->cos_half_sweep;
}

/// The side of an arc's course on which its center is (its inside), or the other side.
[[nodiscard]] inline Sides side_of(const LeafView& arc, bool inside)
{
    return inside == (arc.span->sweep > 0) ? Sides::Left : Sides::Right;
}

/// Normalizes a geometry (winding, unit normals, collinear points), or refuses it in `function`'s name with an error message.
[[nodiscard]] bool normalize_geometry(const char* function, Geometry& geometry);

/// The leaves of a normalized geometry.
[[nodiscard]] std::vector<Leaf> make_leaves(const Geometry& geometry, LeafStore& store);

/// The inverse of make_leaves: the normalized geometry that the leaf was made from, unless it was a chain.
[[nodiscard]] Geometry geometry_of(const LeafView& leaf);
/// The chain that consists of these pieces, at least one.
[[nodiscard]] Chain chain_of(std::span<const LeafView> pieces);

/// Removes repeated and collinear points, and orders the outline counter-clockwise. No removed point is farther from the remaining outline than the
/// tolerance, in m.
[[nodiscard]] std::vector<Vec2> clean_outline(std::span<const Vec2> outline, float tolerance);
[[nodiscard]] bool is_convex(std::span<const Vec2> counter_clockwise);
[[nodiscard]] double signed_area(std::span<const Vec2> outline);

} // namespace carom::internal
