#pragma once

// Distance from a point to the surface of a leaf, with the outward normal there. Circle contacts, times of impact of balls, closest-point queries and
// point tests all need it. Written once for float (contacts) and double (times of impact).
//
// Seams. Only one of two pieces that share a corner may answer for it, or a ball would be pushed twice, and only where the point is in neither
// piece's inside region. The region beyond a piece's end is the half-plane ahead of its end tangent, for lines and
// (near the surface) for arcs alike. So the previous piece never answers for a shared end. The next piece answers for its start only
// when the point is also ahead of the end tangent of the previous piece.

#include "geometry/leaf.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace carom::internal {

template <class R>
struct Surface
{
    R distance; ///< negative inside
    R nx;       ///< outward unit normal of the leaf at the closest point
    R ny;
    /// Curvature of the distance along the tangent as seen from the point: 1 / distance to the center of curvature, 0 on
    /// straight lines, negative where the surface curves around the point (the inside of an arc).
    R curvature;
    int feature;
};

template <class R>
[[nodiscard]] std::optional<Surface<R>> surface_of_circle(R px, R py, R cx, R cy, R radius, int feature)
{
    const R dx = px - cx;
    const R dy = py - cy;
    const R d = std::sqrt(dx * dx + dy * dy);
    if (!(d > 0))
        return Surface<R>{-radius, 0, 1, 0, feature};
    return Surface<R>{d - radius, dx / d, dy / d, 1 / d, feature};
}

/// Whether a shared corner can have contacts: only where the line curves away from its solid side.
[[nodiscard]] inline bool start_may_answer(const Leaf& leaf, Vec2 tangent)
{
    if (!leaf.has_previous || leaf.sides == Sides::Both)
        return true;
    const float bend = cross(leaf.previous_tangent, tangent);
    return leaf.sides == Sides::Left ? bend < 0 : bend > 0;
}

/// Whether the point is in the region of the shared corner that the next piece answers for, on a side that is solid.
template <class R>
[[nodiscard]] bool start_answers(const Leaf& leaf, Vec2 tangent, R dx, R dy)
{
    const R left_of_start = static_cast<R>(tangent.x) * dy - static_cast<R>(tangent.y) * dx;
    if (!leaf.has_previous)
    {
        if (leaf.sides == Sides::Both)
            return true;
        return (leaf.sides == Sides::Left) == (left_of_start > 0);
    }
    if (static_cast<R>(leaf.previous_tangent.x) * dx + static_cast<R>(leaf.previous_tangent.y) * dy < 0)
        return false;
    return start_may_answer(leaf, tangent);
}

template <class R>
[[nodiscard]] bool end_answers(const Leaf& leaf, Vec2 tangent, R dx, R dy)
{
    if (leaf.has_next)
        return false;
    if (leaf.sides == Sides::Both)
        return true;
    const R left_of_end = static_cast<R>(tangent.x) * dy - static_cast<R>(tangent.y) * dx;
    return (leaf.sides == Sides::Left) == (left_of_end > 0);
}

template <class R>
[[nodiscard]] std::optional<Surface<R>> surface_of_start(const LeafView& v, Vec2 tangent, R px, R py)
{
    const Vec2 p = start_point(v);
    if (!start_answers<R>(*v.leaf, tangent, px - p.x, py - p.y))
        return std::nullopt;
    return surface_of_circle<R>(px, py, p.x, p.y, v.leaf->r0, 1);
}

template <class R>
[[nodiscard]] std::optional<Surface<R>> surface_of_end(const LeafView& v, Vec2 tangent, R px, R py)
{
    const Vec2 p = end_point(v);
    if (!end_answers<R>(*v.leaf, tangent, px - p.x, py - p.y))
        return std::nullopt;
    return surface_of_circle<R>(px, py, p.x, p.y, v.leaf->r0, 2);
}

template <class R>
[[nodiscard]] std::optional<Surface<R>> surface_of_segment(const LeafView& v, R px, R py)
{
    const Leaf& leaf = *v.leaf;
    const R ex = static_cast<R>(leaf.p1.x) - leaf.p0.x;
    const R ey = static_cast<R>(leaf.p1.y) - leaf.p0.y;
    const R l = std::sqrt(ex * ex + ey * ey);
    const R ux = ex / l;
    const R uy = ey / l;
    const R dx = px - leaf.p0.x;
    const R dy = py - leaf.p0.y;
    const R along = ux * dx + uy * dy;
    const Vec2 tangent = {static_cast<float>(ux), static_cast<float>(uy)};
    if (along < 0)
        return surface_of_start<R>(v, tangent, px, py);
    if (along > l)
        return surface_of_end<R>(v, tangent, px, py);
    const R left = ux * dy - uy * dx;
    if (is_beside_solid_side(leaf, static_cast<double>(left)))
        return std::nullopt;
    const bool on_left = left > 0 || (left == 0 && leaf.sides != Sides::Right);
    const R sign = on_left ? R(1) : R(-1);
    return Surface<R>{sign * left - leaf.r0, -sign * uy, sign * ux, 0, 0};
}

template <class R>
[[nodiscard]] std::optional<Surface<R>> surface_of_arc(const LeafView& v, R px, R py)
{
    const Leaf& leaf = *v.leaf;
    const ArcSpan& span = *v.span;
    const R dx = px - leaf.p0.x;
    const R dy = py - leaf.p0.y;
    const R d = std::sqrt(dx * dx + dy * dy);
    const R ahead = dx * leaf.p1.x + dy * leaf.p1.y;
    if (d > 0 && ahead >= d * span.cos_half_sweep)
    {
        const bool inside = d < leaf.arc_radius;
        if (leaf.sides != Sides::Both && leaf.sides != side_of(v, inside))
            return std::nullopt;
        const R sign = inside ? R(-1) : R(1);
        return Surface<R>{sign * (d - leaf.arc_radius) - leaf.r0, sign * dx / d, sign * dy / d, sign / d, 0};
    }
    // Beyond the ends, the nearer corner answers.
    const R sx = px - span.start.x;
    const R sy = py - span.start.y;
    const R ex = px - span.end.x;
    const R ey = py - span.end.y;
    if (sx * sx + sy * sy <= ex * ex + ey * ey)
        return surface_of_start<R>(v, start_tangent(v), px, py);
    return surface_of_end<R>(v, end_tangent(v), px, py);
}

/// Distance to a segment's or arc's line, whichever side answers.
[[nodiscard]] inline double distance_to_line(const LeafView& view, double px, double py)
{
    const Leaf& leaf = *view.leaf;
    const auto size = [](double x, double y) { return std::sqrt(x * x + y * y); };
    const auto to_ends = [&]
    {
        const auto to_point = [&](Vec2 v) { return size(px - static_cast<double>(v.x), py - static_cast<double>(v.y)); };
        return std::min(to_point(start_point(view)), to_point(end_point(view))) - static_cast<double>(leaf.r0);
    };
    const double x = px - static_cast<double>(leaf.p0.x);
    const double y = py - static_cast<double>(leaf.p0.y);
    if (leaf.type == LeafType::Segment)
    {
        const double ex = static_cast<double>(leaf.p1.x) - static_cast<double>(leaf.p0.x);
        const double ey = static_cast<double>(leaf.p1.y) - static_cast<double>(leaf.p0.y);
        const double along = ex * x + ey * y;
        const double square = ex * ex + ey * ey;
        return along > 0 && along < square ? std::fabs(ex * y - ey * x) / std::sqrt(square) - static_cast<double>(leaf.r0)
                                           : to_ends();
    }
    const double l = size(x, y);
    const bool ahead = x * static_cast<double>(leaf.p1.x) + y * static_cast<double>(leaf.p1.y) >=
                       l * static_cast<double>(view.span->cos_half_sweep);
    return ahead ? std::fabs(l - static_cast<double>(leaf.arc_radius)) - static_cast<double>(leaf.r0) : to_ends();
}

/// The surface of the convex hull of the circles (point i, radius i): polygons with round corners and capsules, tapered ones included. Edge i touches the
/// circles i and i + 1; its outward normal is given. The edge with the greatest separation is the one that the point is outside of, or nearest to.
template <class R>
[[nodiscard]] Surface<R> surface_of_hull(const Vec2* points, const Vec2* normals, const float radii[2], int count, R px, R py)
{
    int edge = 0;
    R best = 0;
    for (int i = 0; i < count; ++i)
    {
        const R s = static_cast<R>(normals[i].x) * (px - points[i].x) + static_cast<R>(normals[i].y) * (py - points[i].y) -
                    radii[i & (count == 2)];
        if (i == 0 || s > best)
        {
            best = s;
            edge = i;
        }
    }
    const int next = edge + 1 < count ? edge + 1 : 0;
    const float ra = radii[edge & (count == 2)];
    const float rb = radii[next & (count == 2)];
    const Vec2 n = normals[edge];
    const Vec2 a = points[edge] + ra * n; // where the edge touches the two circles
    const Vec2 b = points[next] + rb * n;
    const R ex = static_cast<R>(b.x) - a.x;
    const R ey = static_cast<R>(b.y) - a.y;
    const R along = ex * (px - a.x) + ey * (py - a.y);
    // Inside a polygon's core the exit is over an edge. (A capsule has no inside between its edges: both edges face away from a point ahead of its ends.)
    const bool inside = count > 2 && best + ra <= 0;
    if (!inside && along < 0)
        return *surface_of_circle<R>(px, py, points[edge].x, points[edge].y, ra, count + edge);
    if (!inside && along > ex * ex + ey * ey)
        return *surface_of_circle<R>(px, py, points[next].x, points[next].y, rb, count + next);
    return {best, n.x, n.y, 0, edge};
}

/// Outward normals of the two sides of a capsule. They tilt towards the smaller end by phi, sin(phi) = (r0 - r1) / length.
struct CapsuleSides
{
    Vec2 points[2];
    Vec2 normals[2]; ///< [0]: the edge from p0 to p1, on the right; [1]: the edge back, on the left
    float radii[2];
};

[[nodiscard]] inline CapsuleSides capsule_sides(const Leaf& leaf)
{
    const Vec2 d = leaf.p1 - leaf.p0;
    const float l = length(d);
    const Vec2 u = (1 / l) * d;
    const float s = (leaf.r0 - leaf.r1) / l;
    const float c = std::sqrt(1 - s * s);
    return {{leaf.p0, leaf.p1}, {s * u - c * perp(u), s * u + c * perp(u)}, {leaf.r0, leaf.r1}};
}

/// The surface of a leaf as seen from a point of its body's frame; nullopt where the leaf does not face the point.
template <class R>
[[nodiscard]] std::optional<Surface<R>> surface_at(const LeafView& v, R px, R py)
{
    const Leaf& leaf = *v.leaf;
    switch (leaf.type)
    {
    case LeafType::HalfSpace:
        return Surface<R>{static_cast<R>(leaf.p0.x) * px + static_cast<R>(leaf.p0.y) * py - leaf.r0, leaf.p0.x, leaf.p0.y, 0, 0};
    case LeafType::Circle: return surface_of_circle<R>(px, py, leaf.p0.x, leaf.p0.y, leaf.r0, 0);
    case LeafType::Polygon:
    {
        const float radii[2] = {leaf.r0, leaf.r0};
        return surface_of_hull<R>(v.points, v.normals, radii, leaf.count, px, py);
    }
    case LeafType::Capsule:
    {
        const CapsuleSides sides = capsule_sides(leaf);
        return surface_of_hull<R>(sides.points, sides.normals, sides.radii, 2, px, py);
    }
    case LeafType::Segment: return surface_of_segment<R>(v, px, py);
    case LeafType::Arc: return surface_of_arc<R>(v, px, py);
    }
    return std::nullopt;
}

/// The normal cone of a corner, given by the mean of its two edge normals: the unit vectors n with dot(n, cone) >= dot(cone, cone).
[[nodiscard]] inline Vec2 corner_cone(const Vec2* normals, int count, int corner)
{
    return 0.5f * (normals[corner > 0 ? corner - 1 : count - 1] + normals[corner]);
}

/// The normal cone at an end of a capsule or segment: a half-plane, or less by the taper towards this end.
[[nodiscard]] inline Vec2 end_cone(Vec2 other, Vec2 end, float radius_other, float radius)
{
    const Vec2 along = end - other;
    const float l = length(along);
    const float cosine = std::max((radius_other - radius) / l, 0.01f); // 0 would be the whole plane
    return (cosine / l) * along;
}

/// Radius of a circle inside a shape, about its middle: half its thickness, or a little less.
[[nodiscard]] inline double inner_radius(const LeafView& v)
{
    const Leaf& leaf = *v.leaf;
    if (leaf.type == LeafType::Circle)
        return static_cast<double>(leaf.r0);
    if (leaf.type != LeafType::Polygon)
        return 0.5 * static_cast<double>(leaf.r0 + leaf.r1);
    Vec2 sum{};
    for (int i = 0; i < leaf.count; ++i)
        sum += v.points[i];
    const Vec2 center = (1 / static_cast<float>(leaf.count)) * sum;
    const std::optional<Surface<float>> s = surface_at<float>(v, center.x, center.y);
    return s && s->distance < 0 ? -static_cast<double>(s->distance) : 0;
}

} // namespace carom::internal
