#pragma once

/// @file
/// Small value types of the plane. SI units, angles in radians, counter-clockwise positive, y up.
/// Every function here gives the same bits on every platform: none of them calls the C library's sin or cos.

#include "carom/config.h"

#include <cmath>

namespace carom {

inline constexpr float pi = 3.14159265358979f;

/// A vector of two floats: differences of positions, velocities, forces, and points in a body's own frame.
struct Vec2
{
    float x = 0;
    float y = 0;

    constexpr Vec2& operator+=(Vec2 b) { return *this = {x + b.x, y + b.y}; }
    constexpr Vec2& operator-=(Vec2 b) { return *this = {x - b.x, y - b.y}; }
    constexpr Vec2& operator*=(float s) { return *this = {x * s, y * s}; }
    friend constexpr bool operator==(Vec2, Vec2) = default;
};

[[nodiscard]] constexpr Vec2 operator+(Vec2 a, Vec2 b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] constexpr Vec2 operator-(Vec2 a, Vec2 b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] constexpr Vec2 operator-(Vec2 a) { return {-a.x, -a.y}; }
[[nodiscard]] constexpr Vec2 operator*(float s, Vec2 a) { return {s * a.x, s * a.y}; }
[[nodiscard]] constexpr Vec2 operator*(Vec2 a, float s) { return {s * a.x, s * a.y}; }
[[nodiscard]] constexpr float dot(Vec2 a, Vec2 b) { return a.x * b.x + a.y * b.y; }
/// The z component of the three-dimensional cross product.
[[nodiscard]] constexpr float cross(Vec2 a, Vec2 b) { return a.x * b.y - a.y * b.x; }
/// Velocity of a point at r on a body that turns with w about the origin.
[[nodiscard]] constexpr Vec2 cross(float w, Vec2 r) { return {-w * r.y, w * r.x}; }
/// The vector turned by +90 degrees.
[[nodiscard]] constexpr Vec2 perp(Vec2 a) { return {-a.y, a.x}; }
/// In doubles, where the squares of floats neither vanish nor overflow.
[[nodiscard]] inline float length(Vec2 a)
{
    const double x = a.x;
    const double y = a.y;
    return static_cast<float>(std::sqrt(x * x + y * y));
}
/// The vector at length one; the zero vector stays zero.
[[nodiscard]] CAROM_API Vec2 normalize(Vec2 a);

/// A point of the world, in doubles: the world may be large and impacts stay sharp far from its origin.
/// The difference of two positions is taken in double and given as a Vec2.
struct Position
{
    double x = 0;
    double y = 0;

    constexpr Position() = default;
    constexpr Position(double px, double py) : x(px), y(py) {}
    constexpr Position(Vec2 v) : x(v.x), y(v.y) {}
    constexpr explicit operator Vec2() const { return {static_cast<float>(x), static_cast<float>(y)}; }
    constexpr Position& operator+=(Vec2 d) { return *this = {x + d.x, y + d.y}; }
    friend constexpr bool operator==(Position, Position) = default;
};

[[nodiscard]] constexpr Vec2 operator-(Position a, Position b)
{
    return {static_cast<float>(a.x - b.x), static_cast<float>(a.y - b.y)};
}
[[nodiscard]] constexpr Position operator+(Position a, Vec2 d) { return {a.x + d.x, a.y + d.y}; }
[[nodiscard]] constexpr Position operator-(Position a, Vec2 d) { return {a.x - d.x, a.y - d.y}; }
/// The position narrowed to floats; precise near the origin only.
[[nodiscard]] constexpr Vec2 to_vec2(Position p) { return static_cast<Vec2>(p); }

/// A rotation, held as the cosine and sine of its angle.
struct Rotation
{
    float c = 1;
    float s = 0;

    /// Rotation by an angle in radians; any finite angle.
    [[nodiscard]] CAROM_API static Rotation from_angle(float radians);
    /// The angle in radians, from -pi to pi.
    [[nodiscard]] CAROM_API float angle() const;
    friend constexpr bool operator==(Rotation, Rotation) = default;
};

/// First b, then a.
[[nodiscard]] constexpr Rotation operator*(Rotation a, Rotation b) { return {a.c * b.c - a.s * b.s, a.s * b.c + a.c * b.s}; }
[[nodiscard]] constexpr Vec2 rotate(Rotation q, Vec2 v) { return {q.c * v.x - q.s * v.y, q.s * v.x + q.c * v.y}; }
[[nodiscard]] constexpr Vec2 inverse_rotate(Rotation q, Vec2 v) { return {q.c * v.x + q.s * v.y, q.c * v.y - q.s * v.x}; }
[[nodiscard]] constexpr Rotation inverse(Rotation q) { return {q.c, -q.s}; }

/// Where a body's frame stands in the world.
struct Pose
{
    Position position{};
    Rotation rotation{};
};

/// A point of the body's frame, in the world.
[[nodiscard]] constexpr Position transform(const Pose& pose, Vec2 local) { return pose.position + rotate(pose.rotation, local); }
/// A point of the world, in the body's frame.
[[nodiscard]] constexpr Vec2 inverse_transform(const Pose& pose, Position world)
{
    return inverse_rotate(pose.rotation, world - pose.position);
}

/// An axis-aligned box of the world, edges included.
struct Box
{
    Position lower{};
    Position upper{};
};

} // namespace carom
