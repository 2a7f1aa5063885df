// Hull against hull: separating axes over the edge normals of both, then the incident edge clipped to the reference edge; corner against
// corner where the closest features are two corners. Every offset includes the radius of its point.
//
// Pieces of chains have two more rules. A normal that leans over a seam belongs to the neighbor, so it is replaced by the piece's own
// (no ghost bumps). A one-sided piece touches only hulls whose center is on its solid side.

#include "collision/edge_rules.h"
#include "collision/hull.h"
#include "collision/manifold.h"

#include <algorithm>
#include <utility>

namespace carom::internal {

namespace {

struct FaceAxis
{
    int edge = 0;
    int support = 0; ///< the other hull's point that is lowest along the edge's normal
    float separation = -3e38f;
};

int lowest(const Hull& hull, Vec2 n)
{
    int lowest = 0;
    for (int i = 1; i < hull.count(); ++i)
    {
        if (dot(n, hull.point(i)) - hull.radius(i) < dot(n, hull.point(lowest)) - hull.radius(lowest))
            lowest = i;
    }
    return lowest;
}

FaceAxis best_axis(const Hull& reference, const Hull& other)
{
    FaceAxis best;
    for (int i = 0; i < reference.count(); ++i)
    {
        const int support = lowest(other, reference.normal(i));
        const float s = dot(reference.normal(i), other.point(support)) - other.radius(support) - reference.offset(i);
        if (s > best.separation)
            best = {i, support, s};
    }
    return best;
}

// A point of the incident edge: its core and the radius there.
struct ClipPoint
{
    Vec2 core;
    float radius;
    int id;

    void put_between(const ClipPoint& a, const ClipPoint& b, float t)
    {
        core = a.core + t * (b.core - a.core);
        radius = a.radius + t * (b.radius - a.radius);
    }
};

struct Reference
{
    const Hull& hull;
    const Hull& other;
    bool flipped; ///< whether the reference is b
};

constexpr float lowest_if_none = -1;

// `beyond`: parts of the other hull that are not before the edge, or farther beyond its ends than this, do not touch it.
void clip_to_edge(const Reference& ref, int edge, float margin, LocalManifold& out, float beyond = lowest_if_none)
{
    // The reference edge runs between the points where it touches its two circles.
    const Vec2 n = ref.hull.normal(edge);
    const int next = ref.hull.next(edge);
    const Vec2 start = ref.hull.point(edge) + ref.hull.radius(edge) * n;
    const Vec2 end = ref.hull.point(next) + ref.hull.radius(next) * n;
    const Vec2 tangent = normalize(end - start);
    // The incident edge is clipped to the reference's ends.
    const int i0 = most_opposed_edge(ref.other.count(), [&](int i) { return ref.other.normal(i); }, n);
    const int i1 = ref.other.next(i0);
    ClipPoint points[2] = {{ref.other.point(i0), ref.other.radius(i0), i0}, {ref.other.point(i1), ref.other.radius(i1), i1}};
    // Where corners overlap deeply, clipping may leave nothing of the incident edge: then the other hull's lowest corner is the contact.
    const bool only_before = beyond >= 0;
    const float more = only_before ? beyond : 0;
    const bool left = clip(points, tangent, dot(tangent, start) - more) && clip(points, -tangent, -dot(tangent, end) - more);
    out.clipped.radius = -1;
    if (!left && only_before)
        return;
    if (!left)
    {
        const int lowest_corner = lowest(ref.other, n);
        points[0] = points[1] = {ref.other.point(lowest_corner), ref.other.radius(lowest_corner), lowest_corner};
    }
    // Points within the margin become contact points.
    const float offset = ref.hull.offset(edge);
    out.normal = ref.flipped ? -n : n;
    const bool is_even = left && ref.other.radius(i0) == ref.other.radius(i1);
    out.clipped = {{start, end}, {ref.other.point(i0), ref.other.point(i1)}, ref.flipped, is_even ? ref.other.radius(i0) : -1};
    float left_out = 3e38f;
    for (const ClipPoint& p : points)
    {
        const float separation = dot(n, p.core) - p.radius - offset;
        if (separation > margin)
            left_out = std::min(left_out, separation);
        if (separation > margin && out.count == 0)
            std::swap(out.clipped.corners[0], out.clipped.corners[1]);
        if (separation > margin || (!left && out.count == 1))
            continue;
        const Vec2 on_other = p.core - p.radius * n;
        const Vec2 on_reference = on_other - separation * n;
        out.add(ref.flipped ? on_other : on_reference, ref.flipped ? on_reference : on_other, separation,
                feature_id(ref.flipped, edge, p.id));
    }
    float third = 3e38f;
    for (int i = 0; i < ref.other.count(); ++i)
    {
        if (i != i0 && i != i1)
            third = std::min(third, dot(n, ref.other.point(i)) - ref.other.radius(i) - offset);
    }
    out.bound_by_third(third, left_out);
}

// The closest features of separate shapes are a corner circle of one and the surface of the other.
struct Nearest
{
    float separation = 3e38f;
    Vec2 normal{}; ///< from a to b
    Vec2 on_a{};
    Vec2 on_b{};
    std::uint32_t feature = 0;
    int corner = 0;   ///< corner of the hull whose corners were offered
    int opposite = 0; ///< feature of the other's surface
    bool corner_of_a = false;
};

// False where a corner lies inside the other core: then nearest corners mean nothing.
bool offer_corners(const Hull& surface, const Hull& corners, bool corners_are_a, Nearest& nearest)
{
    for (int i = 0; i < corners.count(); ++i)
    {
        const Vec2 c = corners.point(i);
        const Surface<float> s = surface.surface_at(c);
        if (surface.count() > 2 && s.distance + surface.radius(0) < 0)
            return false;
        const float separation = s.distance - corners.radius(i);
        if (separation >= nearest.separation)
            continue;
        const Vec2 n = {s.nx, s.ny};
        const Vec2 on_surface = c - s.distance * n;
        const Vec2 on_corner = c - corners.radius(i) * n;
        const std::uint32_t feature = corner_feature | (corners_are_a ? 0x8000u : 0u) |
                                      (static_cast<std::uint32_t>(s.feature & 0x7f) << 8) | static_cast<std::uint32_t>(i & 0xff);
        nearest = corners_are_a ? Nearest{separation, -n, on_corner, on_surface, feature, i, s.feature, true}
                                : Nearest{separation, n, on_surface, on_corner, feature, i, s.feature, false};
    }
    return true;
}

void note_corners(const Hull& a, const Hull& b, const Nearest& nearest, LocalManifold& out)
{
    const int opposite = nearest.opposite - (nearest.corner_of_a ? b : a).count();
    if (opposite < 0)
        return;
    const int of_a = nearest.corner_of_a ? nearest.corner : opposite;
    const int of_b = nearest.corner_of_a ? opposite : nearest.corner;
    out.nearest = {{a.point(of_a), b.point(of_b)}, {a.cone(of_a), b.cone(of_b)}, {a.radius(of_a), b.radius(of_b)}};
}

bool lines_cross(Vec2 a, Vec2 b, Vec2 c, Vec2 d)
{
    return (cross(b - a, c - a) > 0) != (cross(b - a, d - a) > 0) && (cross(d - c, a - c) > 0) != (cross(d - c, b - c) > 0);
}

// Cores that cross have no nearest corners.
bool cores_cross(const Hull& a, const Hull& b)
{
    for (int i = 0; i < (a.count() == 2 ? 1 : a.count()); ++i)
    {
        for (int j = 0; j < (b.count() == 2 ? 1 : b.count()); ++j)
        {
            if (lines_cross(a.point(i), a.point(a.next(i)), b.point(j), b.point(b.next(j))))
                return true;
        }
    }
    return false;
}

float edge_length(const Hull& hull, int edge) { return length(hull.point(hull.next(edge)) - hull.point(edge)); }

// Whether the lowest point of the other faces the edge between its ends. Then nothing is nearer: no axis gives a separation greater than the distance, and
// this one attains it.
bool faces_edge(const Hull& reference, const Hull& incident, const FaceAxis& axis)
{
    const int next = reference.next(axis.edge);
    const Vec2 n = reference.normal(axis.edge);
    const Vec2 start = reference.point(axis.edge) + reference.radius(axis.edge) * n;
    const Vec2 edge = reference.point(next) + reference.radius(next) * n - start;
    const float along = dot(edge, incident.point(axis.support) - start);
    const bool even = reference.radius(axis.edge) == reference.radius(next);
    return (even || axis.separation > 0) && along > 0 && along < dot(edge, edge);
}

// The general case, without chain neighbors.
void collide_free(const Hull& a, const Hull& b, float margin, LocalManifold& out)
{
    const FaceAxis axis_a = best_axis(a, b);
    const FaceAxis axis_b = best_axis(b, a);
    const float edge_a = edge_length(a, axis_a.edge);
    const float edge_b = edge_length(b, axis_b.edge);
    const bool flipped = prefers_b(axis_a.separation, edge_a, axis_b.separation, edge_b);
    const Hull& reference = flipped ? b : a;
    const Hull& incident = flipped ? a : b;
    const FaceAxis axis = flipped ? axis_b : axis_a;
    if (axis.separation > margin)
    {
        const Vec2 n = reference.normal(axis.edge);
        out.part(flipped ? -n : n, axis.separation);
        return;
    }
    // For cores that overlap, the edge normals are all the separating axes. For cores that are apart, and for the ends of capsules, they are not: the
    // nearest corner may be farther away than the separation along any edge normal.
    const bool slender = a.count() == 2 || b.count() == 2;
    const float core_gap = axis.separation + std::max(reference.radius(axis.edge), reference.radius(reference.next(axis.edge))) +
                           incident.radius(axis.support);
    if (core_gap > 1e-6f && faces_edge(reference, incident, axis))
    {
        clip_to_edge({reference, incident, flipped}, axis.edge, margin, out);
        return;
    }
    Nearest nearest;
    const bool apart = (slender || core_gap > 1e-6f) && !cores_cross(a, b) && offer_corners(a, b, false, nearest) &&
                       offer_corners(b, a, true, nearest);
    const float tolerance = 1e-4f * std::max(edge_a, edge_b);
    if (!apart || nearest.separation <= axis.separation + tolerance)
        clip_to_edge({reference, incident, flipped}, axis.edge, margin, out);
    // Clipping may also cut off the very corner that is nearest.
    if (apart && nearest.separation <= margin && (out.count == 0 || out.least_separation() > nearest.separation + tolerance))
    {
        out.count = 0;
        out.clipped.radius = -1;
        out.normal = nearest.normal;
        out.add(nearest.on_a, nearest.on_b, nearest.separation, nearest.feature);
        note_corners(a, b, nearest, out);
    }
    if (apart && out.count == 0)
        out.part(nearest.normal, nearest.separation);
}

// Piece and hull in one frame. The manifold's normal runs from the piece to the hull.
void keep_to_piece(const Leaf& piece, const Hull& edge, const Hull& hull, float margin, LocalManifold& out)
{
    const Vec2 tangent = normalize(edge.point(1) - edge.point(0));
    const float side = cross(tangent, hull.center() - edge.point(0));
    if (is_beside_solid_side(piece, static_cast<double>(side)) || is_behind_seam(piece, side, hull.center()))
        out.count = 0;
    if (out.count == 0 || !leans_over_seam(piece, out.normal, tangent, {}))
        return;
    out.count = 0;
    clip_to_edge({edge, hull, false}, side > 0 ? 1 : 0, margin, out, 0); // beyond the seam the contact belongs to the neighbor
}

} // namespace

void clip_to_own_edge(const LeafView& a, int edge, const LeafView& b, const RelativePose& pose, float margin, float beyond,
                      LocalManifold& out)
{
    const Hull hull(a);
    if (b.leaf->type != LeafType::Circle)
    {
        const HullSeen other(b, pose);
        clip_to_edge({hull, other, false}, edge, margin, out, beyond);
        return;
    }
    const Vec2 n = hull.normal(edge);
    const int next = hull.next(edge);
    const Vec2 start = hull.point(edge) + hull.radius(edge) * n;
    const Vec2 end = hull.point(next) + hull.radius(next) * n;
    const Vec2 tangent = normalize(end - start);
    const Vec2 center = pose.to_a(b.leaf->p0);
    const float at = dot(tangent, center - start);
    const float separation = dot(n, center - start) - b.leaf->r0;
    out.normal = n;
    if (at >= -beyond && at <= length(end - start) + beyond && separation <= margin)
        out.add(center - (separation + b.leaf->r0) * n, center - b.leaf->r0 * n, separation, feature_id(false, edge, 0));
}

void collide_hull_hull(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out)
{
    const Hull hull_a(a);
    const HullSeen hull_b(b, pose);
    collide_free(hull_a, hull_b, margin, out);
    const Leaf& piece = *b.leaf;
    if (piece.type != LeafType::Segment || !is_of_chain(piece))
        return;
    // The table passes segments as b; the rules of pieces are written with the piece first, in its own frame.
    const RelativePose swapped{pose.to_b({}), inverse(pose.rotation)};
    const Hull edge(b);
    const HullSeen hull(a, swapped);
    LocalManifold m;
    m.normal = -inverse_rotate(pose.rotation, out.normal);
    for (int i = 0; i < out.count; ++i)
        m.add(pose.to_b(out.points[i].on_b), pose.to_b(out.points[i].on_a), out.points[i].separation, out.points[i].feature);
    keep_to_piece(piece, edge, hull, margin, m);
    out.count = 0;
    out.parting = {};
    out.normal = -rotate(pose.rotation, m.normal);
    for (int i = 0; i < m.count; ++i)
        out.add(pose.to_a(m.points[i].on_b), pose.to_a(m.points[i].on_a), m.points[i].separation, m.points[i].feature);
}

} // namespace carom::internal
