#include "property/plane.h"

#include <algorithm>
#include <limits>

namespace carom::shots {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Nearest
{
    double distance = infinity;
    Point from_b{}; // unit, from b to a
};

std::size_t edge_count(const Outline& o) { return o.core.size() < 3 ? 1 : o.core.size(); }

// Corners of a against edges of b.
void corners_to_edges(const Outline& a, const Outline& b, double sign, Nearest& nearest)
{
    for (const Point p : a.core)
        for (std::size_t i = 0; i < edge_count(b); ++i)
        {
            const Point q = nearest_on_segment(b.core[i], b.core[(i + 1) % b.core.size()], p);
            const double d = norm(p - q);
            if (d < nearest.distance && d > 0)
                nearest = {d, (sign / d) * (p - q)};
        }
}

Nearest nearest_of_cores(const Outline& a, const Outline& b)
{
    Nearest nearest;
    corners_to_edges(a, b, 1, nearest);
    corners_to_edges(b, a, -1, nearest);
    return nearest;
}

double support(const Outline& o, Point d)
{
    double best = -infinity;
    for (const Point p : o.core)
        best = std::max(best, dot(p, d));
    return best;
}

// The largest gap of the cores along any edge normal of either: positive proves them apart.
double gap_along_normals(const Outline& edges, const Outline& other)
{
    double best = -infinity;
    if (edges.core.size() < 2)
        return best;
    for (std::size_t i = 0; i < edges.core.size(); ++i)
    {
        const Point d = unit(edges.core[(i + 1) % edges.core.size()] - edges.core[i]);
        const Point out = -turned_left(d);
        best = std::max(best, -support(other, -out) - support(edges, out));
    }
    return best;
}

} // namespace

Outline moved(const Outline& outline, Point position, double angle)
{
    Outline out{{}, outline.radius};
    for (const Point p : outline.core)
        out.core.push_back(position + turn(angle, p));
    return out;
}

Outline moved(const Outline& outline, const Pose& pose)
{
    const double c = static_cast<double>(pose.rotation.c);
    const double s = static_cast<double>(pose.rotation.s);
    Outline out{{}, outline.radius};
    for (const Point p : outline.core)
        out.core.push_back({pose.position.x + c * p.x - s * p.y, pose.position.y + s * p.x + c * p.y});
    return out;
}

Point nearest_on_segment(Point a, Point b, Point p)
{
    const Point d = b - a;
    const double length2 = dot(d, d);
    if (length2 == 0)
        return a;
    return a + std::clamp(dot(p - a, d) / length2, 0.0, 1.0) * d;
}

double separation(const Outline& a, const Outline& b)
{
    const double gap = std::max(gap_along_normals(a, b), gap_along_normals(b, a));
    const double cores = gap < 0 ? gap : nearest_of_cores(a, b).distance;
    return cores - a.radius - b.radius;
}

Meeting first_meeting(const Outline& mover, Point v, const Outline& target, double time)
{
    // Conservative advancement: the gap closes no faster than the speed.
    const double speed = norm(v);
    const double radii = mover.radius + target.radius;
    double t = 0;
    // 400 looks are enough but for ways almost along a side: one in 100,000.
    for (int i = 0; i < 20000 && t <= time; ++i)
    {
        const Nearest nearest = nearest_of_cores(moved(mover, t * v, 0), target);
        const double gap = nearest.distance - radii;
        const double closing = -dot(v, nearest.from_b);
        if (gap <= 1e-12 * (1 + radii))
            return {closing > 0, t, nearest.from_b};
        t += gap / speed;
    }
    return {};
}

} // namespace carom::shots
