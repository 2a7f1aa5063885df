#include "pinball/table/plane_geometry.h"

#include <algorithm>

namespace carom::pinball {
namespace {

constexpr double two_pi = 2 * 3.14159265358979323846;

/// True if the arc passes at this angle.
bool arc_covers(const Curve& arc, double angle)
{
    double turned = arc.sweep > 0 ? angle - arc.start : arc.start - angle;
    turned -= two_pi * std::floor(turned / two_pi);
    return turned <= std::abs(arc.sweep);
}

bool arc_covers(const Curve& arc, Point p)
{
    const Point from_center = p - arc.center;
    return arc_covers(arc, std::atan2(from_center.y, from_center.x));
}

Point closest_on_segment(const Curve& line, Point p)
{
    const Point along = line.b - line.a;
    const double size = dot(along, along);
    const double t = size > 0 ? std::clamp(dot(p - line.a, along) / size, 0.0, 1.0) : 0.0;
    return line.a + t * along;
}

Point nearer(Point p, Point a, Point b) { return length(p - a) <= length(p - b) ? a : b; }

/// Where the infinite line through the segment cuts the circle of the arc.
void add_line_circle_cuts(const Curve& line, const Curve& arc, std::vector<Point>& points)
{
    const Point along = unit(line.b - line.a);
    const double foot = dot(arc.center - line.a, along);
    const double height = cross(along, arc.center - line.a);
    const double root = arc.radius * arc.radius - height * height;
    if (root < 0)
        return;
    points.push_back(line.a + (foot - std::sqrt(root)) * along);
    points.push_back(line.a + (foot + std::sqrt(root)) * along);
}

void add_circle_circle_cuts(const Curve& a, const Curve& b, std::vector<Point>& points)
{
    const Point between = b.center - a.center;
    const double d = length(between);
    if (d < 1e-9)
        return;
    const double foot = (d * d + a.radius * a.radius - b.radius * b.radius) / (2 * d);
    const double root = a.radius * a.radius - foot * foot;
    if (root < 0)
        return;
    const Point along = (1 / d) * between;
    points.push_back(a.center + foot * along + std::sqrt(root) * perp(along));
    points.push_back(a.center + foot * along - std::sqrt(root) * perp(along));
}

/// Points of the plane whose projections on both curves may be a closest pair: ends, crossings, and feet of centres.
std::vector<Point> critical_points(const Curve& a, const Curve& b)
{
    std::vector<Point> points = {a.a, a.b, b.a, b.b};
    if (!a.is_arc && !b.is_arc)
    {
        const double turn = cross(a.b - a.a, b.b - b.a);
        if (std::abs(turn) > 1e-15)
            points.push_back(a.a + (cross(b.a - a.a, b.b - b.a) / turn) * (a.b - a.a));
    }
    else if (a.is_arc && b.is_arc)
    {
        const Point along = unit(b.center - a.center);
        for (const double sign : {-1.0, 1.0})
        {
            points.push_back(a.center + (sign * a.radius) * along);
            points.push_back(b.center + (sign * b.radius) * along);
        }
        add_circle_circle_cuts(a, b, points);
    }
    else
    {
        const Curve& line = a.is_arc ? b : a;
        const Curve& arc = a.is_arc ? a : b;
        points.push_back(closest_on_segment(line, arc.center));
        const Point away = perp(unit(line.b - line.a));
        points.push_back(arc.center + arc.radius * away);
        points.push_back(arc.center - arc.radius * away);
        add_line_circle_cuts(line, arc, points);
    }
    return points;
}

} // namespace

Point unit(Point a)
{
    const double size = length(a);
    return size > 0 ? (1 / size) * a : Point{1, 0};
}

Curve make_line(Point a, Point b, double thickness) { return {.a = a, .b = b, .thickness = thickness}; }

Curve make_circle(Point center, double radius) { return {.a = center, .b = center, .thickness = radius}; }

Curve make_arc(Point a, Point b, double sweep, double thickness)
{
    const Point chord = b - a;
    const Point center = 0.5 * (a + b) + (0.5 / std::tan(sweep / 2)) * perp(chord);
    const Point spoke = a - center;
    return {.is_arc = true,
            .a = a,
            .b = b,
            .center = center,
            .radius = length(spoke),
            .start = std::atan2(spoke.y, spoke.x),
            .sweep = sweep,
            .thickness = thickness};
}

Point closest_point(const Curve& curve, Point p)
{
    if (!curve.is_arc)
        return closest_on_segment(curve, p);
    if (arc_covers(curve, p))
        return curve.center + curve.radius * unit(p - curve.center);
    return nearer(p, curve.a, curve.b);
}

double distance(const Curve& curve, Point p) { return length(p - closest_point(curve, p)) - curve.thickness; }

std::vector<Approach> approaches(const Curve& a, const Curve& b)
{
    std::vector<Approach> found;
    for (const Point p : critical_points(a, b))
    {
        // Projecting twice turns any critical point into a point pair that really lies on the curves.
        const Point on_a = closest_point(a, p);
        const Point on_b = closest_point(b, on_a);
        const Point back = closest_point(a, on_b);
        found.push_back({back, on_b, length(back - on_b) - a.thickness - b.thickness});
        const Point other_b = closest_point(b, p);
        const Point other_a = closest_point(a, other_b);
        found.push_back({other_a, other_b, length(other_a - other_b) - a.thickness - b.thickness});
    }
    return found;
}

Approach closest_approach(const Curve& a, const Curve& b)
{
    const std::vector<Approach> all = approaches(a, b);
    return *std::min_element(all.begin(), all.end(),
                             [](const Approach& p, const Approach& q) { return p.clearance < q.clearance; });
}

std::vector<Curve> curves_of(const Chain& chain)
{
    std::vector<Curve> curves;
    Point from = chain.start;
    for (const ChainPiece& piece : chain.pieces)
    {
        const Point to = piece.end;
        curves.push_back(piece.sweep == 0 ? make_line(from, to, chain.half_thickness)
                                          : make_arc(from, to, piece.sweep, chain.half_thickness));
        from = to;
    }
    return curves;
}

std::vector<Point> flatten(const Chain& chain)
{
    std::vector<Point> points = {chain.start};
    for (const Curve& curve : curves_of(chain))
    {
        const int steps = curve.is_arc ? 1 + static_cast<int>(std::abs(curve.sweep) * 57.3) : 1;
        for (int i = 1; i < steps; ++i)
            points.push_back(curve.center + curve.radius * unit(curve.start + curve.sweep * i / steps));
        points.push_back(curve.b);
    }
    return points;
}

bool contains(const std::vector<Point>& polygon, Point p)
{
    bool inside = false;
    for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++)
    {
        const Point a = polygon[i];
        const Point b = polygon[j];
        if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
            inside = !inside;
    }
    return inside;
}

} // namespace carom::pinball
