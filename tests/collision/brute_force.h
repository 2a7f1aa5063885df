#pragma once

/// @file
/// Distances between leaves in doubles, by sampling boundaries: slow, simple, and written without the engine's geometry.

#include "geometry/leaf.h"
#include "support/test_scene.h"

#include <algorithm>
#include <vector>

namespace carom::test {

struct Point
{
    double x = 0;
    double y = 0;
};

/// A convex shape as the hull of circles, an arc as a sampled curve of one radius, or a half-plane.
struct Solid
{
    std::vector<Point> core; ///< hull points, or points along the arc
    std::vector<double> radius;
    bool curve = false; ///< consecutive points only (an arc), not their hull
    bool plane = false;
    Point normal{};
    double offset = 0;
};

inline Point place(const Pose& pose, double x, double y)
{
    const double c = pose.rotation.c;
    const double s = pose.rotation.s;
    return {pose.position.x + c * x - s * y, pose.position.y + s * x + c * y};
}

inline Solid solid_of(const Geometry& geometry, const Pose& pose)
{
    Solid s;
    const auto add = [&](Vec2 p, double r)
    {
        s.core.push_back(place(pose, p.x, p.y));
        s.radius.push_back(r);
    };
    if (const auto* circle = std::get_if<Circle>(&geometry))
    {
        add(circle->center, circle->radius);
    }
    else if (const auto* polygon = std::get_if<Polygon>(&geometry))
    {
        for (const Vec2 v : polygon->vertices)
            add(v, polygon->radius);
    }
    else if (const auto* capsule = std::get_if<Capsule>(&geometry))
    {
        add(capsule->a, capsule->radius_a);
        add(capsule->b, capsule->radius_b);
    }
    else if (const auto* segment = std::get_if<Segment>(&geometry))
    {
        add(segment->a, segment->half_thickness);
        add(segment->b, segment->half_thickness);
    }
    else if (const auto* arc = std::get_if<Arc>(&geometry))
    {
        s.curve = true;
        for (int i = 0; i <= 400; ++i)
        {
            const double angle = static_cast<double>(arc->start_angle) + static_cast<double>(arc->sweep) * i / 400;
            s.core.push_back(place(pose, arc->center.x + static_cast<double>(arc->radius) * std::cos(angle),
                                   arc->center.y + static_cast<double>(arc->radius) * std::sin(angle)));
            s.radius.push_back(arc->half_thickness);
        }
    }
    else if (const auto* half = std::get_if<HalfSpace>(&geometry))
    {
        s.plane = true;
        const Point n = place({{}, pose.rotation}, half->normal.x, half->normal.y);
        const double l = std::hypot(n.x, n.y);
        s.normal = {n.x / l, n.y / l};
        s.offset = static_cast<double>(half->offset) + pose.position.x * s.normal.x + pose.position.y * s.normal.y;
    }
    return s;
}

inline double segment_distance(Point p, Point a, Point b)
{
    const double ex = b.x - a.x;
    const double ey = b.y - a.y;
    const double l2 = ex * ex + ey * ey;
    const double t = l2 > 0 ? std::clamp(((p.x - a.x) * ex + (p.y - a.y) * ey) / l2, 0.0, 1.0) : 0;
    return std::hypot(p.x - a.x - t * ex, p.y - a.y - t * ey);
}

/// Support of a convex solid: the greatest dot(n, p) over it.
inline double support(const Solid& s, double nx, double ny)
{
    double best = -1e300;
    for (std::size_t i = 0; i < s.core.size(); ++i)
        best = std::max(best, nx * s.core[i].x + ny * s.core[i].y + s.radius[i]);
    return best;
}

/// Signed distance of two convex solids: the greatest separation over all directions, refined by golden steps; negative is overlap.
inline double convex_separation(const Solid& a, const Solid& b, double* angle_out = nullptr)
{
    const auto at = [&](double angle)
    {
        const double nx = std::cos(angle);
        const double ny = std::sin(angle);
        return -support(b, -nx, -ny) - support(a, nx, ny);
    };
    constexpr int n = 720;
    constexpr double step = 2 * 3.14159265358979323846 / n;
    double values[n];
    double top = -1e300;
    for (int i = 0; i < n; ++i)
        top = std::max(top, values[i] = at(i * step));
    double best = -1e300;
    for (int i = 0; i < n; ++i)
    {
        // Refine every local maximum that could be the best: the function is piecewise smooth with slope at most the sizes.
        if (values[i] < values[(i + 1) % n] || values[i] < values[(i + n - 1) % n] || values[i] < top - 0.1)
            continue;
        double low = (i - 1) * step;
        double high = (i + 1) * step;
        for (int k = 0; k < 60; ++k)
        {
            const double m1 = low + (high - low) / 3;
            const double m2 = high - (high - low) / 3;
            (at(m1) < at(m2) ? low : high) = at(m1) < at(m2) ? m1 : m2;
        }
        const double value = std::max(at(0.5 * (low + high)), values[i]);
        if (value > best)
        {
            best = value;
            if (angle_out != nullptr)
                *angle_out = 0.5 * (low + high);
        }
    }
    return best;
}

/// Greatest separation of a convex solid from a plane.
inline double plane_separation(const Solid& plane, const Solid& s)
{
    return -support(s, -plane.normal.x, -plane.normal.y) - plane.offset;
}

} // namespace carom::test
