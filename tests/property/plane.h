#pragma once

/// @file
/// The shots' own geometry: points in doubles, and convex outlines as a core polygon with a radius around it. It shares nothing
/// with the engine's distance code, so that a mistake there is not repeated here.

#include "carom/math.h"

#include <cmath>
#include <vector>

namespace carom::shots {

struct Point
{
    double x = 0;
    double y = 0;
};

[[nodiscard]] inline Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] inline Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline Point operator-(Point a) { return {-a.x, -a.y}; }
[[nodiscard]] inline Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
[[nodiscard]] inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double norm(Point a) { return std::hypot(a.x, a.y); }
[[nodiscard]] inline Point unit(Point a) { return (1 / norm(a)) * a; }
[[nodiscard]] inline Point turned_left(Point a) { return {-a.y, a.x}; }
[[nodiscard]] inline Point direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
[[nodiscard]] inline Point turn(double angle, Point a)
{
    const Point d = direction(angle);
    return {d.x * a.x - d.y * a.y, d.y * a.x + d.x * a.y};
}

[[nodiscard]] inline Point point(Position p) { return {p.x, p.y}; }
[[nodiscard]] inline Point point(Vec2 v) { return {static_cast<double>(v.x), static_cast<double>(v.y)}; }
[[nodiscard]] inline Position position(Point p) { return {p.x, p.y}; }
[[nodiscard]] inline Vec2 vec(Point p) { return {static_cast<float>(p.x), static_cast<float>(p.y)}; }

/// As a float holds it. Through memory: g++ 12 takes a pair of these for nothing to do (it packs the conversions and cancels them).
[[nodiscard]] inline double as_float(double x)
{
    const volatile float narrow = static_cast<float>(x);
    return static_cast<double>(narrow);
}
[[nodiscard]] inline Point as_floats(Point p) { return {as_float(p.x), as_float(p.y)}; }

/// All points within the radius of a convex polygon: one point makes a disc, two a capsule. Counter-clockwise.
struct Outline
{
    std::vector<Point> core{};
    double radius = 0;
};

/// Where and when a moving outline first meets another one; n points from the target to the mover.
struct Meeting
{
    bool meets = false;
    double time = 0;
    Point n{};
};

[[nodiscard]] Outline moved(const Outline& outline, Point position, double angle);
[[nodiscard]] Outline moved(const Outline& outline, const Pose& pose);

/// From the nearest point of the segment to p; inside a core the distance counts as negative.
[[nodiscard]] Point nearest_on_segment(Point a, Point b, Point p);

/// Distance of the two surfaces; negative by the depth of the least overlap of the cores less the radii.
[[nodiscard]] double separation(const Outline& a, const Outline& b);

/// The first meeting of an outline that moves with v, without turning, and a resting one within the time.
[[nodiscard]] Meeting first_meeting(const Outline& mover, Point v, const Outline& target, double time);

} // namespace carom::shots
