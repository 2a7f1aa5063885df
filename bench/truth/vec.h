#pragma once

/// @file
/// A vector of doubles: experiments and their exact references compute in doubles whatever an engine computes in.

#include <cmath>

namespace truth {

struct Vec
{
    double x = 0;
    double y = 0;

    friend constexpr Vec operator+(Vec a, Vec b) { return {a.x + b.x, a.y + b.y}; }
    friend constexpr Vec operator-(Vec a, Vec b) { return {a.x - b.x, a.y - b.y}; }
    friend constexpr Vec operator-(Vec a) { return {-a.x, -a.y}; }
    friend constexpr Vec operator*(double s, Vec a) { return {s * a.x, s * a.y}; }
};

[[nodiscard]] constexpr double dot(Vec a, Vec b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] constexpr double cross(Vec a, Vec b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] constexpr Vec cross(double w, Vec r) { return {-w * r.y, w * r.x}; }
[[nodiscard]] constexpr Vec perp(Vec a) { return {-a.y, a.x}; }
[[nodiscard]] inline double length(Vec a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline Vec direction(double angle) { return {std::cos(angle), std::sin(angle)}; }
[[nodiscard]] inline Vec rotate(double angle, Vec v)
{
    const Vec q = direction(angle);
    return {q.x * v.x - q.y * v.y, q.y * v.x + q.x * v.y};
}
/// Angle between two directions, 0 to pi.
[[nodiscard]] inline double angle_between(Vec a, Vec b) { return std::abs(std::atan2(cross(a, b), dot(a, b))); }

inline constexpr double pi = 3.14159265358979323846;
[[nodiscard]] constexpr double radians(double degrees) { return degrees * (pi / 180); }
[[nodiscard]] constexpr double degrees(double radians) { return radians * (180 / pi); }

} // namespace truth
