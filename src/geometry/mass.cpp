// Integration of mass, center of mass and moment of inertia over polygons, capsules and circles.

#include "geometry/mass.h"

#include "core/trigonometry.h"

#include <cmath>

namespace carom::internal {

namespace {

constexpr double pi_d = 3.14159265358979323846;

// Sums areas with their first and second moments about the origin of the body. Every convex shape is a sum of triangles and sectors.
struct Moments
{
    double area = 0;
    double x = 0; ///< integral of x
    double y = 0;
    double second = 0; ///< integral of x² + y²

    void add_piece(double piece_area, double cx, double cy, double inertia_about_center)
    {
        area += piece_area;
        x += piece_area * cx;
        y += piece_area * cy;
        second += inertia_about_center + piece_area * (cx * cx + cy * cy);
    }

    // Triangle (origin, a, b), signed. Second moment of a triangle with one corner at the origin: A/6 (a·a + a·b + b·b).
    void add_triangle(double ax, double ay, double bx, double by)
    {
        const double triangle = 0.5 * (ax * by - ay * bx);
        area += triangle;
        x += triangle * (ax + bx) / 3;
        y += triangle * (ay + by) / 3;
        second += triangle / 6 * (ax * ax + ay * ay + ax * bx + ay * by + bx * bx + by * by);
    }

    // Sector of radius r and opening angle 2h about direction u: area h r², centroid at 2 r sin h / (3 h), polar moment r⁴ h / 2.
    void add_sector(double px, double py, double ux, double uy, double r, double h)
    {
        if (h <= 0 || r <= 0)
            return;
        const double sector = h * r * r;
        const double d = 2 * r * sin_cos(h).sin / (3 * h);
        add_piece(sector, px + d * ux, py + d * uy, 0.5 * h * r * r * r * r - sector * d * d);
    }

    [[nodiscard]] LeafMass result(double density) const
    {
        if (!(area > 0))
            return {};
        const double cx = x / area;
        const double cy = y / area;
        return {density * area, cx, cy, density * (second - area * (cx * cx + cy * cy))};
    }
};

// The outline runs along p_i + r n for each edge normal n, joined by sectors at the corners.
Moments polygon_moments(const LeafView& v)
{
    Moments m;
    const int n = v.leaf->count;
    const double r = v.leaf->r0;
    for (int i = 0; i < n; ++i)
    {
        const Vec2 a = v.points[i];
        const Vec2 b = v.points[(i + 1) % n];
        m.add_triangle(a.x, a.y, b.x, b.y);
        if (!(r > 0))
            continue;
        const Vec2 e = v.normals[i];
        const double ox = r * e.x;
        const double oy = r * e.y;
        m.add_triangle(a.x, a.y, a.x + ox, a.y + oy); // the strip along the edge, as a signed loop a, a+o, b+o, b
        m.add_triangle(a.x + ox, a.y + oy, b.x + ox, b.y + oy);
        m.add_triangle(b.x + ox, b.y + oy, b.x, b.y);
        m.add_triangle(b.x, b.y, a.x, a.y);
        const Vec2 next = v.normals[(i + 1) % n];
        const double h = 0.5 * arc_tangent(cross(e, next), dot(e, next));
        const Vec2 u = normalize(e + next);
        m.add_sector(b.x, b.y, u.x, u.y, r, h);
    }
    return m;
}

// Two tangent lines and two caps. With sin(phi) = (r0 - r1)/L, the cap at p0 opens by pi + 2 phi, the one at p1 by pi - 2 phi.
Moments capsule_moments(Vec2 p0, Vec2 p1, double r0, double r1)
{
    Moments m;
    const Vec2 u = normalize(p1 - p0);
    const double l = length(p1 - p0);
    const double s = (r0 - r1) / l;
    const double c = std::sqrt(1 - s * s);
    const double phi = arc_tangent(s, c);
    const double upper_x = u.x * s - u.y * c; // outward normal of the left tangent line
    const double upper_y = u.y * s + u.x * c;
    const double lower_x = u.x * s + u.y * c;
    const double lower_y = u.y * s - u.x * c;
    const double corners[6][2] = {
        {p0.x + r0 * lower_x, p0.y + r0 * lower_y}, {p1.x + r1 * lower_x, p1.y + r1 * lower_y}, {p1.x, p1.y},
        {p1.x + r1 * upper_x, p1.y + r1 * upper_y}, {p0.x + r0 * upper_x, p0.y + r0 * upper_y}, {p0.x, p0.y}};
    for (int i = 0; i < 6; ++i)
        m.add_triangle(corners[i][0], corners[i][1], corners[(i + 1) % 6][0], corners[(i + 1) % 6][1]);
    m.add_sector(p0.x, p0.y, -u.x, -u.y, r0, 0.5 * pi_d + phi);
    m.add_sector(p1.x, p1.y, u.x, u.y, r1, 0.5 * pi_d - phi);
    return m;
}

} // namespace

LeafMass leaf_mass(const LeafView& view, float density)
{
    const Leaf& leaf = *view.leaf;
    switch (leaf.type)
    {
    case LeafType::Circle:
    {
        const double r = leaf.r0;
        const double mass = density * pi_d * r * r;
        return {mass, leaf.p0.x, leaf.p0.y, 0.5 * mass * r * r};
    }
    case LeafType::Polygon: return polygon_moments(view).result(density);
    case LeafType::Capsule: return capsule_moments(leaf.p0, leaf.p1, leaf.r0, leaf.r1).result(density);
    case LeafType::Segment: return leaf.r0 > 0 ? capsule_moments(leaf.p0, leaf.p1, leaf.r0, leaf.r0).result(density) : LeafMass{};
    case LeafType::Arc:
    case LeafType::HalfSpace: break;
    }
    return {};
}

} // namespace carom::internal
