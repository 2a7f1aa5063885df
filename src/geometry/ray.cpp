// Ray casts: the nearest of a ray's intersections with the circles, edges and arcs that bound a leaf.

#include "geometry/ray.h"

#include "geometry/surface.h"

#include <cmath>

namespace carom::internal {

namespace {

// Keeps the nearest of several hits.
struct Nearest
{
    std::optional<LeafHit> hit;

    void offer(double fraction, Vec2 normal)
    {
        if (fraction >= 0 && fraction <= 1 && (!hit || fraction < static_cast<double>(hit->fraction)))
            hit = LeafHit{static_cast<float>(fraction), normal};
    }
};

struct Ray
{
    Vec2 o;
    Vec2 d;

    [[nodiscard]] Vec2 at(double t) const { return {static_cast<float>(o.x + t * d.x), static_cast<float>(o.y + t * d.y)}; }
};

struct Roots
{
    bool real = false;
    double first = 0;
    double second = 0;
};

// Solves |o + t d - c|² = r².
Roots meet_circle(const Ray& ray, Vec2 c, double r)
{
    const double mx = static_cast<double>(ray.o.x) - c.x;
    const double my = static_cast<double>(ray.o.y) - c.y;
    const double dx = ray.d.x;
    const double dy = ray.d.y;
    const double a = dx * dx + dy * dy;
    const double b = mx * dx + my * dy;
    const double q = b * b - a * (mx * mx + my * my - r * r);
    if (!(a > 0) || q < 0)
        return {};
    const double root = std::sqrt(q);
    return {true, (-b - root) / a, (-b + root) / a};
}

void offer_circle(Nearest& nearest, const Ray& ray, Vec2 c, float r)
{
    const Roots t = meet_circle(ray, c, r);
    if (t.real)
        nearest.offer(t.first, normalize(ray.at(t.first) - c));
}

// An edge from a to b with outward normal n, hit from outside.
void offer_edge(Nearest& nearest, const Ray& ray, Vec2 a, Vec2 b, Vec2 n)
{
    const double approach = -(static_cast<double>(n.x) * ray.d.x + static_cast<double>(n.y) * ray.d.y);
    if (approach <= 0)
        return;
    const double height = static_cast<double>(n.x) * (static_cast<double>(ray.o.x) - a.x) +
                          static_cast<double>(n.y) * (static_cast<double>(ray.o.y) - a.y);
    const double t = height / approach;
    const Vec2 p = ray.at(t);
    if (dot(p - a, b - a) >= 0 && dot(p - b, a - b) >= 0)
        nearest.offer(t, n);
}

void offer_hull(Nearest& nearest, const Ray& ray, const Vec2* points, const Vec2* normals, const float radii[2], int count)
{
    for (int i = 0; i < count; ++i)
    {
        const int j = i + 1 < count ? i + 1 : 0;
        const float ri = radii[i & (count == 2)];
        const float rj = radii[j & (count == 2)];
        offer_edge(nearest, ray, points[i] + ri * normals[i], points[j] + rj * normals[i], normals[i]);
        if (ri > 0)
            offer_circle(nearest, ray, points[i], ri);
    }
}

void offer_line(Nearest& nearest, const Ray& ray, const Leaf& leaf)
{
    const Vec2 n = perp(normalize(leaf.p1 - leaf.p0));
    if (leaf.sides != Sides::Right)
        offer_edge(nearest, ray, leaf.p0 + leaf.r0 * n, leaf.p1 + leaf.r0 * n, n);
    if (leaf.sides != Sides::Left)
        offer_edge(nearest, ray, leaf.p0 - leaf.r0 * n, leaf.p1 - leaf.r0 * n, -n);
}

void offer_arc(Nearest& nearest, const Ray& ray, const LeafView& v)
{
    const Leaf& leaf = *v.leaf;
    const auto on_arc = [&](Vec2 p) { return is_in_sweep(v, p - leaf.p0); };
    const Roots outer = meet_circle(ray, leaf.p0, static_cast<double>(leaf.arc_radius) + leaf.r0);
    const Roots inner = meet_circle(ray, leaf.p0, static_cast<double>(leaf.arc_radius) - leaf.r0);
    if (outer.real && leaf.sides != side_of(v, true) && on_arc(ray.at(outer.first)))
        nearest.offer(outer.first, normalize(ray.at(outer.first) - leaf.p0));
    if (inner.real && leaf.sides != side_of(v, false) && on_arc(ray.at(inner.second)))
        nearest.offer(inner.second, -normalize(ray.at(inner.second) - leaf.p0));
}

void offer_leaf(Nearest& nearest, const Ray& ray, const LeafView& v)
{
    const Leaf& leaf = *v.leaf;
    switch (leaf.type)
    {
    case LeafType::HalfSpace:
    {
        const float approach = -dot(leaf.p0, ray.d);
        if (approach > 0)
            nearest.offer((static_cast<double>(dot(leaf.p0, ray.o)) - leaf.r0) / approach, leaf.p0);
        break;
    }
    case LeafType::Circle: offer_circle(nearest, ray, leaf.p0, leaf.r0); break;
    case LeafType::Polygon:
    {
        const float radii[2] = {leaf.r0, leaf.r0};
        offer_hull(nearest, ray, v.points, v.normals, radii, leaf.count);
        break;
    }
    case LeafType::Capsule:
    {
        const CapsuleSides sides = capsule_sides(leaf);
        offer_hull(nearest, ray, sides.points, sides.normals, sides.radii, 2);
        break;
    }
    case LeafType::Segment:
    case LeafType::Arc:
        leaf.type == LeafType::Segment ? offer_line(nearest, ray, leaf) : offer_arc(nearest, ray, v);
        if (leaf.r0 > 0 && leaf.sides == Sides::Both)
        {
            offer_circle(nearest, ray, start_point(v), leaf.r0);
            offer_circle(nearest, ray, end_point(v), leaf.r0);
        }
        break;
    }
}

} // namespace

std::optional<LeafHit> ray_leaf(const LeafView& v, Vec2 origin, Vec2 translation)
{
    const std::optional<Surface<float>> start = surface_at<float>(v, origin.x, origin.y);
    if (start && start->distance < 0)
        return LeafHit{0, {}};
    Nearest nearest;
    offer_leaf(nearest, {origin, translation}, v);
    return nearest.hit;
}

} // namespace carom::internal
