#include "truth/engines/facets.h"

namespace truth {
namespace {

Vec unit(Vec v) { return (1 / length(v)) * v; }

} // namespace

Polygon facets(const Capsule& capsule)
{
    const Vec along = unit(capsule.b - capsule.a);
    Polygon result;
    for (const double degree : {-90.0, -30.0, 30.0, 90.0})
    {
        result.vertices.push_back(capsule.b + capsule.radius * rotate(radians(degree), along));
    }
    for (const double degree : {90.0, 150.0, 210.0, 270.0})
    {
        result.vertices.push_back(capsule.a + capsule.radius * rotate(radians(degree), along));
    }
    return result;
}

std::vector<Vec> grown(const Polygon& polygon)
{
    const std::size_t count = polygon.vertices.size();
    std::vector<Vec> result;
    for (std::size_t i = 0; i < count; ++i)
    {
        const Vec here = polygon.vertices[i];
        const Vec before = -perp(unit(here - polygon.vertices[(i + count - 1) % count]));
        const Vec after = -perp(unit(polygon.vertices[(i + 1) % count] - here));
        result.push_back(here + polygon.radius / (1 + dot(before, after)) * (before + after));
    }
    return result;
}

} // namespace truth
