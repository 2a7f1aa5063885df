#pragma once

// A leaf is a shape as collision sees it: plain data in its body's frame. A chain becomes several leaves; every other public
// shape becomes one. Polygons keep their vertices in a store of their own, so that leaves stay plain and small.

#include "carom/math.h"
#include "carom/shape.h"

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
    bool has_previous = false; ///< the seam at the start is shared with the piece before
    bool has_next = false;
    std::int32_t first = 0; ///< polygon: vertices [first, first + count) of the store
    std::int32_t count = 0;
    /// Circle: p0 center, r0 radius. Capsule: circles (p0, r0), (p1, r1). Segment: from p0 to p1, r0 = r1 half thickness.
    /// Half-space: p0 normal, r0 offset. Polygon: r0 corner radius. Arc: p0 center, r0 half thickness, p1 unit direction of its middle.
    Vec2 p0{};
    Vec2 p1{};
    float r0 = 0;
    float r1 = 0;
    float arc_radius = 0;
    float start_angle = 0;
    float sweep = 0;
    float cos_half_sweep = 0;
    Vec2 arc_start{}; ///< ends of an arc
    Vec2 arc_end{};
    Vec2 previous_tangent{}; ///< direction in which the piece before arrives at the start
    Vec2 next_tangent{};     ///< direction in which the piece after leaves the end
};

/// A piece with neighbours, or solid on one side alone.
[[nodiscard]] inline bool is_of_chain(const Leaf& leaf)
{
    return leaf.has_previous || leaf.has_next || leaf.sides != Sides::Both;
}

/// Of what is so far on the left of a piece: is the piece solid on the other side alone?
[[nodiscard]] inline bool is_beside_solid_side(const Leaf& piece, double left)
{
    return (piece.sides == Sides::Left && left < 0) || (piece.sides == Sides::Right && left > 0);
}

/// Vertices and outward edge normals of all polygons of a scene (edge i runs from vertex i to i + 1).
class VertexStore
{
public:
    [[nodiscard]] int allocate(int count);
    void release(int first, int count);
    Vec2* points(int first) { return m_points.data() + first; }
    Vec2* normals(int first) { return m_normals.data() + first; }
    [[nodiscard]] const Vec2* points(int first) const { return m_points.data() + first; }
    [[nodiscard]] const Vec2* normals(int first) const { return m_normals.data() + first; }

private:
    struct Hole
    {
        std::int32_t first;
        std::int32_t count;
    };
    std::vector<Vec2> m_points;
    std::vector<Vec2> m_normals;
    std::vector<Hole> m_holes;
};

/// A leaf with its vertices at hand.
struct LeafView
{
    const Leaf* leaf;
    const Vec2* points = nullptr;
    const Vec2* normals = nullptr;
};

[[nodiscard]] inline LeafView view(const Leaf& leaf, const VertexStore& store)
{
    if (leaf.type != LeafType::Polygon)
        return {&leaf};
    return {&leaf, store.points(leaf.first), store.normals(leaf.first)};
}

/// The unit direction of an arc or segment at its start and end, along its course.
[[nodiscard]] Vec2 start_tangent(const Leaf& leaf);
[[nodiscard]] Vec2 end_tangent(const Leaf& leaf);
[[nodiscard]] Vec2 start_point(const Leaf& leaf);
[[nodiscard]] Vec2 end_point(const Leaf& leaf);

/// Normalises a geometry (winding, unit normals, collinear points) or refuses it in `function`'s name with a sentence.
[[nodiscard]] bool normalize_geometry(const char* function, Geometry& geometry);

/// The leaves of a normalised geometry. Polygon vertices go to the store.
[[nodiscard]] std::vector<Leaf> make_leaves(const Geometry& geometry, VertexStore& store);

/// Back: the normalised geometry that the leaf was made from, where it was no chain.
[[nodiscard]] Geometry geometry_of(const LeafView& leaf);
/// The chain that has these pieces, at least one.
[[nodiscard]] Chain chain_of(std::span<const LeafView> pieces);

/// Removes repeated and collinear points and turns the outline counter-clockwise. Tolerance in m.
[[nodiscard]] std::vector<Vec2> clean_outline(std::span<const Vec2> outline, float tolerance);
[[nodiscard]] bool is_convex(std::span<const Vec2> counter_clockwise);
[[nodiscard]] double signed_area(std::span<const Vec2> outline);

} // namespace carom::internal
