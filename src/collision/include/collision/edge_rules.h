#pragma once

// Rules that the two files on convex outlines (manifold_hull_hull.cpp, manifold_outlines.cpp) share.

#include "carom/math.h"
#include "geometry/leaf.h"

#include <algorithm>
#include <cstdint>

namespace carom::internal {

constexpr float prefers_bias = 2e-4f; ///< relative to the longer edge

/// Whether the reference edge is b's. While the hulls overlap, a small bias favors the longer edge, or a, so that the choice (and with it the features that
/// carry impulses) does not flicker between equals: rounding alone tips a stack of boxes.
[[nodiscard]] inline bool prefers_b(float separation_a, float edge_a, float separation_b, float edge_b)
{
    const float bias = separation_b < 0 ? prefers_bias * std::max(edge_a, edge_b) : 0;
    return separation_b > separation_a + (edge_b > 1.001f * edge_a ? -bias : bias);
}

/// Index of the edge that faces n most, among `count` edges with the normals normal(i).
template <class Normal>
[[nodiscard]] int most_opposed_edge(int count, const Normal& normal, Vec2 n)
{
    int edge = 0;
    float least = 3e38f;
    for (int i = 0; i < count; ++i)
    {
        const float d = dot(n, normal(i));
        if (d < least)
        {
            least = d;
            edge = i;
        }
    }
    return edge;
}

/// Keeps the part of an edge on the side where dot(n, p) >= offset; false where nothing is left. A point has a core, and is moved between two others by
/// put_between(a, b, t), which leaves its other members unchanged.
template <class Point>
[[nodiscard]] bool clip(Point points[2], Vec2 n, float offset)
{
    const float d0 = dot(n, points[0].core) - offset;
    const float d1 = dot(n, points[1].core) - offset;
    if (d0 < 0 && d1 < 0)
        return false;
    if (d0 < 0 || d1 < 0)
        (d0 < 0 ? points[0] : points[1]).put_between(points[0], points[1], d0 / (d0 - d1));
    return true;
}

/// Feature of a point that was clipped to an edge; flipped: the edge is b's.
[[nodiscard]] inline std::uint32_t feature_id(bool flipped, int reference_edge, int incident_point)
{
    return (flipped ? 1u << 31 : 0u) | (static_cast<std::uint32_t>(reference_edge) << 16) |
           static_cast<std::uint32_t>(incident_point);
}

/// Whether the normal leans so far over a seam that it belongs to the neighbor. Over a convex corner, normals between the two pieces' own are allowed.
/// The normal, out of the piece, and the tangent are given in a frame to which `turn` rotates the piece's.
[[nodiscard]] inline bool leans_over_seam(const Leaf& piece, Vec2 normal, Vec2 tangent, Rotation turn)
{
    const auto leans = [&](Vec2 into_piece, Vec2 into_neighbour)
    { return dot(normal, into_piece) < -1e-3f && dot(normal, into_neighbour) > 1e-3f; };
    return (piece.has_previous && leans(tangent, -rotate(turn, piece.previous_tangent))) ||
           (piece.has_next && leans(-tangent, rotate(turn, piece.next_tangent)));
}

/// Whether a hull's center, in the piece's frame and `side` to the left of its line, is behind that line but before the neighbor, over a convex corner. Then
/// the contact belongs to the neighbor.
[[nodiscard]] inline bool is_behind_seam(const Leaf& piece, float side, Vec2 center)
{
    return piece.sides == Sides::Both && (piece.has_previous || piece.has_next) &&
           is_left_of_chain(piece, center.x, center.y) != (side > 0);
}

/// Bit of features of the nearest point of a corner, which is clipped to no edge.
inline constexpr std::uint32_t corner_feature = 1u << 30;

/// Whether two points were clipped to edges of different hulls. Then their places tell whether they are the same, and not their features: a choice between
/// faces that are nearly parallel names all points anew.
[[nodiscard]] inline bool is_reference_changed(std::uint32_t before, std::uint32_t now)
{
    return ((before ^ now) >> 31) != 0 && ((before | now) & corner_feature) == 0;
}

} // namespace carom::internal
