#pragma once

/// @file
/// Exact distances between thick lines and arcs, in doubles. For the table checker only: nothing here feeds the simulation.

#include "carom/math.h"
#include "carom/shape.h"

#include <cmath>
#include <vector>

namespace carom::pinball {

struct Point
{
    double x = 0;
    double y = 0;

    constexpr Point() = default;
    constexpr Point(double px, double py) : x(px), y(py) {}
    constexpr Point(Vec2 v) : x(v.x), y(v.y) {}
};

[[nodiscard]] constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] constexpr Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] constexpr Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
[[nodiscard]] constexpr double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] constexpr double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] constexpr Point perp(Point a) { return {-a.y, a.x}; }
[[nodiscard]] inline double length(Point a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline Point unit(double angle) { return {std::cos(angle), std::sin(angle)}; }
/// The vector at length one; the zero vector gives (1, 0).
[[nodiscard]] Point unit(Point a);

/// A line or a circular arc with a half thickness; a circle is a line from a point to itself.
struct Curve
{
    bool is_arc = false;
    Point a{}; ///< ends
    Point b{};
    Point center{}; ///< of an arc
    double radius = 0;
    double start = 0; ///< angle, rad
    double sweep = 0;
    double thickness = 0; ///< half
};

[[nodiscard]] Curve make_line(Point a, Point b, double thickness);
[[nodiscard]] Curve make_circle(Point center, double radius);
/// The arc from a to b that turns by sweep.
[[nodiscard]] Curve make_arc(Point a, Point b, double sweep, double thickness);

/// The point of the centre line nearest to p.
[[nodiscard]] Point closest_point(const Curve& curve, Point p);
/// From p to the surface; negative inside.
[[nodiscard]] double distance(const Curve& curve, Point p);

/// Where two curves come close: a point on each centre line and the clearance between the surfaces.
struct Approach
{
    Point on_a{};
    Point on_b{};
    double clearance = 0;
};

/// Every place where their distance may have a local minimum; never empty.
[[nodiscard]] std::vector<Approach> approaches(const Curve& a, const Curve& b);
[[nodiscard]] Approach closest_approach(const Curve& a, const Curve& b);

[[nodiscard]] std::vector<Curve> curves_of(const Chain& chain);
/// The chain as a polygon, arcs in steps of one degree: at most 0.04 mm off for a radius of a metre.
[[nodiscard]] std::vector<Point> flatten(const Chain& chain);
/// By the even-odd rule.
[[nodiscard]] bool contains(const std::vector<Point>& polygon, Point p);

} // namespace carom::pinball
