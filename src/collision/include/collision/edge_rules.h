#pragma once

// What the two files on convex outlines (manifold_hull_hull.cpp, manifold_outlines.cpp) choose by the same rule.

#include "carom/math.h"
#include "geometry/leaf.h"

#include <algorithm>
#include <cstdint>

namespace carom::internal {

constexpr float prefers_bias = 2e-4f; ///< of the longer edge

/// While they overlap a little in favour of the longer edge, or of a, so that the choice (and with it the features that carry impulses) does not
/// flicker between equals: rounding alone tips a stack of boxes.
[[nodiscard]] inline bool prefers_b(float separation_a, float edge_a, float separation_b, float edge_b)
{
    const float bias = separation_b < 0 ? prefers_bias * std::max(edge_a, edge_b) : 0;
    return separation_b > separation_a + (edge_b > 1.001f * edge_a ? -bias : bias);
}

/// Of count edges, normal(i) being their normals: the one that faces n most.
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

/// Keeps the part of an edge on the side where dot(n, p) >= offset; false where nothing is left. A point has a core, and goes between two others by
/// put_between(a, b, t); what else it has stays.
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

/// Of a point that was clipped to an edge; flipped: the edge is b's.
[[nodiscard]] inline std::uint32_t feature_id(bool flipped, int reference_edge, int incident_point)
{
    return (flipped ? 1u << 31 : 0u) | (static_cast<std::uint32_t>(reference_edge) << 16) |
           static_cast<std::uint32_t>(incident_point);
}

/// Does a seam leave the normal to the neighbour? Allowed are normals between the two pieces' own, over a convex corner. Normal, out of the piece, and
/// tangent are given in a frame that the piece's is turned to.
[[nodiscard]] inline bool leans_over_seam(const Leaf& piece, Vec2 normal, Vec2 tangent, Rotation turn)
{
    const auto leans = [&](Vec2 into_piece, Vec2 into_neighbour)
    { return dot(normal, into_piece) < -1e-3f && dot(normal, into_neighbour) > 1e-3f; };
    return (piece.has_previous && leans(tangent, -rotate(turn, piece.previous_tangent))) ||
           (piece.has_next && leans(-tangent, rotate(turn, piece.next_tangent)));
}

/// Has a hull its center, in the piece's frame and `side` to the left of its line, behind that line but before the neighbour, over a convex corner? Then
/// the neighbour has it.
[[nodiscard]] inline bool is_behind_seam(const Leaf& piece, float side, Vec2 center)
{
    return piece.sides == Sides::Both && (piece.has_previous || piece.has_next) &&
           is_left_of_chain(piece, center.x, center.y) != (side > 0);
}

/// Between two corners, or of a surface without edges: no edge's normal.
[[nodiscard]] inline bool is_of_edge(std::uint32_t feature) { return (feature & (0x4000u << 16)) == 0; }
[[nodiscard]] inline bool edge_is_of_b(std::uint32_t feature) { return (feature & (1u << 31)) != 0; }

} // namespace carom::internal
