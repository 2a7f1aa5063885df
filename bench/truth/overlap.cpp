#include "truth/overlap.h"

#include <algorithm>
#include <limits>

namespace truth {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A shape's hull in its own frame.
struct ToHull
{
    Hull operator()(const Disc& disc) const { return {{disc.center}, disc.radius}; }
    Hull operator()(const Polygon& polygon) const { return {polygon.vertices, polygon.radius}; }
    Hull operator()(const Segment& segment) const { return {{segment.a, segment.b}, 0}; }
    Hull operator()(const Capsule& capsule) const { return {{capsule.a, capsule.b}, capsule.radius}; }
};

Vec outward(Vec from, Vec to) { return (-1 / length(to - from)) * perp(to - from); }

/// Largest separation of b over the edges of a: separating axes, one hull's half. A segment has an edge on either side.
double separation(const std::vector<Vec>& a, const std::vector<Vec>& b)
{
    double largest = -infinite;
    for (std::size_t i = 0; a.size() > 1 && i < a.size(); ++i)
    {
        const Vec normal = outward(a[i], a[(i + 1) % a.size()]);
        double nearest = infinite;
        for (const Vec v : b)
        {
            nearest = std::min(nearest, dot(v - a[i], normal));
        }
        largest = std::max(largest, nearest);
    }
    return largest;
}

double distance_to_segment(Vec p, Vec a, Vec b)
{
    const Vec along = b - a;
    const double square = dot(along, along);
    const double t = square > 0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0;
    return length(p - (a + t * along));
}

/// Least distance of b's corners to a's edges.
double corner_distance(const std::vector<Vec>& a, const std::vector<Vec>& b)
{
    double least = infinite;
    for (const Vec corner : b)
    {
        for (std::size_t i = 0; i < a.size(); ++i)
        {
            least = std::min(least, distance_to_segment(corner, a[i], a[(i + 1) % a.size()]));
        }
    }
    return least;
}

/// Separation of two hulls without radius; negative where they overlap.
double signed_distance(const std::vector<Vec>& a, const std::vector<Vec>& b)
{
    const double depth = std::max(separation(a, b), separation(b, a));
    return depth > -infinite && depth <= 0 ? depth : std::min(corner_distance(a, b), corner_distance(b, a));
}

} // namespace

Hull hull(const Placed& placed)
{
    Hull result = std::visit(ToHull{}, placed.shape);
    for (Vec& corner : result.corners)
    {
        corner = placed.position + rotate(placed.angle, corner);
    }
    return result;
}

double overlap(const Hull& a, const Hull& b) { return a.radius + b.radius - signed_distance(a.corners, b.corners); }

double overlap(const Placed& a, const Placed& b) { return overlap(hull(a), hull(b)); }

double reach(const Shape& shape)
{
    const Hull whole = std::visit(ToHull{}, shape);
    double largest = 0;
    for (const Vec corner : whole.corners)
    {
        largest = std::max(largest, length(corner));
    }
    return largest + whole.radius;
}

} // namespace truth
