#include "truth/overlap.h"

#include <algorithm>
#include <limits>

namespace truth {
namespace {

std::vector<Vec> vertices_of(const Polygon& polygon, const Placed& at)
{
    std::vector<Vec> result;
    for (const Vec v : polygon.vertices)
    {
        result.push_back(at.position + rotate(at.angle, v));
    }
    return result;
}

Vec outward(Vec from, Vec to) { return (-1 / length(to - from)) * perp(to - from); }

/// Largest separation of b over the edges of a: separating axes, one polygon's half.
double separation(const std::vector<Vec>& a, const std::vector<Vec>& b)
{
    double largest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        const Vec normal = outward(a[i], a[(i + 1) % a.size()]);
        double nearest = std::numeric_limits<double>::infinity();
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
    const double t = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
    return length(p - (a + t * along));
}

/// Distance of a point to a polygon's surface, negative inside.
double signed_distance(Vec p, const std::vector<Vec>& polygon)
{
    const double inside = separation(polygon, {p});
    if (inside <= 0)
    {
        return inside;
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
        least = std::min(least, distance_to_segment(p, polygon[i], polygon[(i + 1) % polygon.size()]));
    }
    return least;
}

} // namespace

double overlap(const Placed& a, const Placed& b)
{
    const Disc* disc_a = std::get_if<Disc>(&a.shape);
    const Disc* disc_b = std::get_if<Disc>(&b.shape);
    if (disc_a && disc_b)
    {
        return disc_a->radius + disc_b->radius - length(b.position - a.position);
    }
    if (disc_b)
    {
        return overlap(b, a);
    }
    const std::vector<Vec> polygon_b = vertices_of(std::get<Polygon>(b.shape), b);
    if (disc_a)
    {
        return disc_a->radius - signed_distance(a.position, polygon_b);
    }
    const std::vector<Vec> polygon_a = vertices_of(std::get<Polygon>(a.shape), a);
    return -std::max(separation(polygon_a, polygon_b), separation(polygon_b, polygon_a));
}

double reach(const Shape& shape)
{
    if (const Disc* disc = std::get_if<Disc>(&shape))
    {
        return disc->radius;
    }
    double largest = 0;
    for (const Vec v : std::get<Polygon>(shape).vertices)
    {
        largest = std::max(largest, length(v));
    }
    return largest;
}

} // namespace truth
