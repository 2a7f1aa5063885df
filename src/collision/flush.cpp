// Contacts of leaves with flush neighbors. With n the normal out of the touched leaf at p, and the neighbors within the tolerance of p:
//
//   goes_on(p, n)   some neighbor's surface lies ahead of p along n: the union has no such normal there
//   exposed edges   edges of the touched leaf near p whose normal does not go on a little to either side
//
// The normal is real where it does not go on, or is that of an exposed edge. Otherwise it is turned to the exposed edge with the greatest separation from the
// visitor, unless that edge is the exit on the leaf's far side. Where no part of the visitor is before such an edge, the contact belongs to the neighbor.

#include "collision/flush.h"

#include "collision/hull.h"
#include "geometry/leaf_traits.h"
#include "geometry/surface.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace carom::internal {

namespace {

struct Point
{
    double x = 0;
    double y = 0;
};

Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
Point operator*(double k, Point a) { return {k * a.x, k * a.y}; }
double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
double magnitude(Point a) { return std::sqrt(dot(a, a)); }
Point wide(Vec2 v) { return {static_cast<double>(v.x), static_cast<double>(v.y)}; }

Point rotated(Rotation q, Point p)
{
    const Point r = {static_cast<double>(q.c), static_cast<double>(q.s)};
    return {r.x * p.x - r.y * p.y, r.y * p.x + r.x * p.y};
}

Point rotated_back(Rotation q, Point p)
{
    const Point r = {static_cast<double>(q.c), static_cast<double>(q.s)};
    return {r.x * p.x + r.y * p.y, r.x * p.y - r.y * p.x};
}

// The surface of a convex leaf by itself, without seams and one-sidedness.
Surface<double> whole_surface(const LeafView& v, Point p)
{
    const Leaf& leaf = *v.leaf;
    if (leaf.type == LeafType::HalfSpace)
    {
        const Point n = wide(leaf.p0);
        return {dot(n, p) - static_cast<double>(leaf.r0), n.x, n.y, 0, 0};
    }
    if (leaf.type == LeafType::Polygon)
    {
        const float radii[2] = {leaf.r0, leaf.r0};
        return surface_of_hull<double>(v.points, v.normals, radii, leaf.count, p.x, p.y);
    }
    const CapsuleSides sides = capsule_sides(leaf);
    return surface_of_hull<double>(sides.points, sides.normals, sides.radii, 2, p.x, p.y);
}

// The same as the public function, in doubles.
bool is_farther(const LeafView& v, Point p, double reach)
{
    const Leaf& leaf = *v.leaf;
    if (leaf.type == LeafType::HalfSpace)
        return false;
    if (leaf.type == LeafType::Polygon)
    {
        const double most = reach + static_cast<double>(leaf.r0);
        for (int i = 0; i < leaf.count; ++i)
        {
            if (dot(wide(v.normals[i]), p - wide(v.points[i])) > most)
                return true;
        }
        return false;
    }
    const Point d = wide(leaf.p1) - wide(leaf.p0);
    const Point displacement = p - wide(leaf.p0);
    const double along = std::clamp(dot(displacement, d), 0.0, dot(d, d));
    const Point off = dot(d, d) * displacement - along * d;
    const double most = (reach + static_cast<double>(std::max(leaf.r0, leaf.r1))) * dot(d, d);
    return dot(off, off) > most * most;
}

class Union
{
public:
    Union(const LeafView& touched, const FlushNeighbours& neighbours, const LeafView& visitor, const RelativePose& pose)
        : m_hull(touched), m_touched(touched), m_neighbours(neighbours), m_visitor(visitor), m_pose(pose),
          m_tolerance(neighbours.tolerance)
    {}

    [[nodiscard]] FlushAnswer ask(std::span<const Vec2> points, Vec2 n) const
    {
        const auto is_free = [&](Vec2 p) { return !goes_on(wide(p), wide(n)); };
        if (std::ranges::any_of(points, is_free))
            return {};
        const Point p = wide(points[0]);
        FlushAnswer best;
        double farthest = -1e300;
        bool is_hidden = false;
        const int nearest = nearest_edge(p); // the other edges seldom have a greater separation
        for (int i = 0; i < m_hull.count(); ++i)
        {
            const int edge = (nearest + i) % m_hull.count();
            const double under = depth_under(edge, p);
            const double least = -std::max(under, 0.0) - 2 * m_tolerance;
            const bool is_face = carom::dot(m_hull.normal(edge), n) > 0.999999f;
            const bool may_hide = std::fabs(under) <= m_tolerance;
            if (!is_face && !may_hide && greatest_separation(edge) < std::max(least, farthest))
                continue;
            if (!is_solid(edge) || !is_exposed(edge, p))
                continue;
            if (is_face)
                return {}; // its face goes on beyond the neighbor
            const std::optional<double> separation = least_separation(edge);
            if (!separation)
            {
                is_hidden |= may_hide;
                continue;
            }
            if (*separation >= least && *separation > farthest)
            { // otherwise it is the exit on the far side
                farthest = *separation;
                best = {FlushVerdict::Turned, edge};
            }
        }
        if (best.verdict == FlushVerdict::Real && is_hidden)
            best.verdict = FlushVerdict::Hidden;
        return best; // real by default: no contact is left out without a reason
    }

private:
    [[nodiscard]] static Point in(const FlushNeighbour& other, Point p)
    {
        return rotated_back(other.pose.rotation, p - wide(other.pose.position));
    }

    struct Nearest
    {
        double distance; ///< 0 inside
        Point at;
        Point normal;
    };

    [[nodiscard]] static Nearest nearest(const FlushNeighbour& other, Point p)
    {
        const Surface<double> s = whole_surface(other.leaf, in(other, p));
        const Point n = rotated(other.pose.rotation, {s.nx, s.ny});
        if (s.distance <= 0)
            return {0, p, n};
        return {s.distance, p - s.distance * n, n};
    }

    // Whether a neighbor's surface goes on from p in the direction n.
    [[nodiscard]] bool goes_on(Point p, Point n) const
    {
        return std::ranges::any_of(m_neighbours.all(),
                                   [&](const FlushNeighbour& other)
                                   {
                                       if (is_farther(other.leaf, in(other, p), m_tolerance) ||
                                           nearest(other, p).distance > m_tolerance)
                                           return false;
                                       const Point displacement = nearest(other, p + 2 * m_tolerance * n).at - p;
                                       const double l = magnitude(displacement);
                                       return l > 0.002 * m_tolerance && dot(n, displacement) > 1e-3 * l;
                                   });
    }

    // One side of a segment may be open.
    [[nodiscard]] bool is_solid(int edge) const
    {
        const Leaf& leaf = *m_touched.leaf;
        return leaf.type != LeafType::Segment || leaf.sides == Sides::Both ||
               leaf.sides == (edge == 1 ? Sides::Left : Sides::Right);
    }

    // Whether the edge is part of the surface of the union, near the point.
    [[nodiscard]] bool is_exposed(int edge, Point p) const
    {
        const Point n = wide(m_hull.normal(edge));
        const int next = m_hull.next(edge);
        const Point start = wide(m_hull.point(edge)) + static_cast<double>(m_hull.radius(edge)) * n;
        const Point along = wide(m_hull.point(next)) + static_cast<double>(m_hull.radius(next)) * n - start;
        const double l = magnitude(along);
        if (!(l > 0))
            return false;
        const Point t = (1 / l) * along;
        const double at = std::clamp(dot(t, p - start), 0.0, l);
        for (const double sign : {-1.0, 1.0})
        {
            const double room = sign < 0 ? at : l - at;
            if (room < m_tolerance)
                continue;
            const Point q = start + (at + sign * std::min(room, 4 * m_tolerance)) * t;
            const auto is_hidden = [&] { return goes_on(start + at * t, n) && is_behind_neighbour(q, p); };
            if (!goes_on(q, n) && !is_hidden())
                return true;
        }
        return false;
    }

    // Whether q is behind a neighbor at p, as seen from the visitor.
    [[nodiscard]] bool is_behind_neighbour(Point q, Point p) const
    {
        const Point center = wide(m_pose.to_a(middle_of(m_visitor)));
        return std::ranges::any_of(m_neighbours.all(),
                                   [&](const FlushNeighbour& other)
                                   {
                                       const Nearest at = nearest(other, p);
                                       if (at.distance > m_tolerance)
                                           return false;
                                       const Surface<double> s = whole_surface(other.leaf, in(other, center));
                                       const Point n = rotated(other.pose.rotation, {s.nx, s.ny});
                                       return dot(n, q - at.at) < -0.5 * m_tolerance;
                                   });
    }

    [[nodiscard]] static Vec2 middle_of(const LeafView& v)
    {
        return v.leaf->type == LeafType::Circle ? v.leaf->p0 : Hull(v).center();
    }

    [[nodiscard]] double depth_under(int edge, Point p) const
    {
        const Point n = wide(m_hull.normal(edge));
        return dot(n, wide(m_hull.point(edge)) - p) + static_cast<double>(m_hull.radius(edge));
    }

    // The edge whose line is nearest to the point.
    [[nodiscard]] int nearest_edge(Point p) const
    {
        int nearest = 0;
        for (int edge = 1; edge < m_hull.count(); ++edge)
        {
            if (std::fabs(depth_under(edge, p)) < std::fabs(depth_under(nearest, p)))
                nearest = edge;
        }
        return nearest;
    }

    // Separation of the visitor's farthest point along the edge's normal: no point of it has a greater one.
    [[nodiscard]] double greatest_separation(int edge) const
    {
        const Vec2 n = inverse_rotate(m_pose.rotation, m_hull.normal(edge));
        const Leaf& leaf = *m_visitor.leaf;
        float farthest = carom::dot(n, leaf.p0) + leaf.r0;
        if (leaf.type == LeafType::Polygon)
        {
            farthest = -3e38f;
            for (int i = 0; i < leaf.count; ++i)
                farthest = std::max(farthest, carom::dot(n, m_visitor.points[i]) + leaf.r0);
        }
        else if (traits_of(leaf).has_two_ends)
            farthest = std::max(farthest, carom::dot(n, leaf.p1) + leaf.r1);
        return static_cast<double>(farthest + carom::dot(m_hull.normal(edge), m_pose.position) - m_hull.offset(edge));
    }

    // The least separation of the visitor's points that are before the edge.
    [[nodiscard]] std::optional<double> least_separation(int edge) const
    {
        LocalManifold m;
        clip_to_own_edge(m_touched, edge, m_visitor, m_pose, 3e38f, static_cast<float>(m_tolerance), m);
        if (m.count == 0)
            return std::nullopt;
        return static_cast<double>(m.least_separation());
    }

    Hull m_hull;
    const LeafView& m_touched;
    const FlushNeighbours& m_neighbours;
    const LeafView& m_visitor;
    const RelativePose& m_pose; ///< pose of the visitor in the touched leaf's frame
    double m_tolerance;
};

} // namespace

bool may_be_flush(const Leaf& leaf) { return traits_of(leaf).has_edges || !traits_of(leaf).is_bounded; }

bool is_farther(const LeafView& leaf, Vec2 point, double reach) { return is_farther(leaf, wide(point), reach); }

Vec2 touched_point(const LocalManifold& m, int i, bool of_a, const RelativePose& pose)
{
    return of_a ? m.points[i].on_a : pose.to_b(m.points[i].on_b);
}

bool may_be_hidden(const LeafView& touched, const RelativePose& pose, bool of_a, double tolerance, const LocalManifold& m)
{
    if (!traits_of(*touched.leaf).has_edges)
        return false;
    const Hull hull(touched);
    const Vec2 n = of_a ? m.normal : -inverse_rotate(pose.rotation, m.normal);
    for (int edge = 0; edge < hull.count(); ++edge)
    {
        if (carom::dot(hull.normal(edge), n) < 0.999999f)
            continue;
        const Vec2 start = hull.point(edge);
        const Vec2 along = hull.point(hull.next(edge)) - start;
        const float l = length(along);
        for (int i = 0; i < m.count; ++i)
        {
            const Vec2 p = touched_point(m, i, of_a, pose);
            const float at = carom::dot(p - start, along) / l;
            const float room = 2 * static_cast<float>(tolerance) + std::max(-m.points[i].separation, 0.0f);
            if (at > room && at < l - room)
                return false;
        }
        return true;
    }
    return true;
}

Vec2 edge_normal(const LeafView& leaf, int edge) { return Hull(leaf).normal(edge); }

FlushAnswer ask_flush(const LeafView& touched, const FlushNeighbours& neighbours, const LeafView& visitor,
                      const RelativePose& pose, std::span<const Vec2> points, Vec2 n)
{
    if (neighbours.count == 0 || points.empty() || !traits_of(*touched.leaf).has_edges || !traits_of(*visitor.leaf).has_corners)
        return {};
    return Union(touched, neighbours, visitor, pose).ask(points, n);
}

namespace {

// Points of the manifold about as near as the nearest, on a's surface or b's, in a's frame.
struct NearPoints
{
    Vec2 list[2];
    std::size_t count = 0;

    NearPoints(const LocalManifold& m, bool of_a, double tolerance)
    {
        float least = 3e38f;
        for (int i = 0; i < m.count; ++i)
            least = std::min(least, m.points[i].separation);
        for (int i = 0; i < m.count; ++i)
        {
            if (static_cast<double>(m.points[i].separation - least) <= tolerance)
                list[count++] = of_a ? m.points[i].on_a : m.points[i].on_b;
        }
    }
};

void leave_out(LocalManifold& m)
{
    m.count = 0;
    m.parting = {};
    m.reach = -3e38f; // forces a new search wherever the leaves are
    m.clipped.radius = -1;
    m.nearest.radii[0] = m.nearest.radii[1] = -1;
}

} // namespace

bool keep_to_union(const LeafView& a, const FlushNeighbours& of_a, const LeafView& b, const FlushNeighbours& of_b,
                   const RelativePose& pose, float margin, LocalManifold& m)
{
    if (m.count == 0)
        return false;
    const RelativePose back{pose.to_b({}), inverse(pose.rotation)};
    const NearPoints on_a(m, true, of_a.tolerance);
    NearPoints on_b(m, false, of_b.tolerance);
    for (Vec2& p : std::span(on_b.list).first(on_b.count))
        p = pose.to_b(p);
    const FlushAnswer answer_a = ask_flush(a, of_a, b, pose, std::span(on_a.list).first(on_a.count), m.normal);
    const FlushAnswer answer_b =
        ask_flush(b, of_b, a, back, std::span(on_b.list).first(on_b.count), -inverse_rotate(pose.rotation, m.normal));
    if (answer_a.verdict == FlushVerdict::Real && answer_b.verdict == FlushVerdict::Real)
        return false;
    LocalManifold turned;
    const auto turn = [&](const FlushAnswer& answer, bool by_a)
    {
        if (answer.verdict != FlushVerdict::Turned)
            return;
        LocalManifold own;
        if (by_a)
            clip_to_own_edge(a, answer.edge, b, pose, margin, static_cast<float>(of_a.tolerance), own);
        else
            clip_to_own_edge(b, answer.edge, a, back, margin, static_cast<float>(of_b.tolerance), own);
        if (own.count == 0 || (turned.count > 0 && own.least_separation() <= turned.least_separation()))
            return;
        turned = own;
        for (int i = 0; i < own.count && !by_a; ++i)
        {
            turned.points[i].on_a = pose.to_a(own.points[i].on_b);
            turned.points[i].on_b = pose.to_a(own.points[i].on_a);
        }
        turned.normal = by_a ? own.normal : -rotate(pose.rotation, own.normal);
    };
    turn(answer_a, true);
    turn(answer_b, false);
    leave_out(m);
    m.normal = turned.normal;
    m.count = turned.count;
    std::copy_n(turned.points, turned.count, m.points);
    return true;
}

} // namespace carom::internal
