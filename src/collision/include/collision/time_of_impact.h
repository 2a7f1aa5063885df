#pragma once

// Time of impact of two moving leaves. Both paths are exact functions of time: a point of the body along a parabola, and a rotation about it
// with steady angular acceleration. All in double; the target is zero distance.
//
// Two leaves always touch at a corner of one: a circle, an end of a capsule, a vertex, the bulge of an arc. So a leaf is treated as a few
// probes, circles fixed to its body, and the question becomes when a probe meets the surface of the other leaf.

#include "carom/math.h"
#include "geometry/leaf.h"

#include <cmath>
#include <cstdint>
#include <optional>

namespace carom::internal {

/// Computed by the square root, which every machine rounds alike; hypot depends on the library.
[[nodiscard]] inline double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

/// Two circles at constant velocity meet at the first root of |d + v t| = radius; 0 where they overlap, 1e300 where they never meet. d and v run from one center
/// to the other; radius: the sum of both.
[[nodiscard]] inline double first_meeting_of_circles(double dx, double dy, double vx, double vy, double radius)
{
    const double apart = dx * dx + dy * dy - radius * radius;
    if (apart <= 0)
        return 0;
    const double closing = -(dx * vx + dy * vy);
    const double discriminant = closing * closing - (vx * vx + vy * vy) * apart;
    return closing > 0 && discriminant >= 0 ? apart / (closing + std::sqrt(discriminant)) : 1e300;
}

/// x + v t + a t²/2 for each coordinate.
struct CenterPath
{
    double x = 0;
    double y = 0;
    double vx = 0;
    double vy = 0;
    double ax = 0;
    double ay = 0;
};

struct FramePath
{
    CenterPath center;   ///< path of the point that the body turns about: its center of mass, or a pivot
    Vec2 local_center{}; ///< that point in the body's frame
    double c = 1;        ///< rotation at t = 0
    double s = 0;
    double w = 0;     ///< rad/s at t = 0
    double alpha = 0; ///< rad/s²
};

/// The same path starting at `time`.
[[nodiscard]] FramePath path_after(const FramePath& path, double time);
/// The same path run backwards from t = 0.
[[nodiscard]] FramePath run_back(const FramePath& path);

/// Corners of both leaves, one bit each.
struct ProbeSet
{
    std::uint32_t of_a = 0;
    std::uint32_t of_b = 0;

    void add(int probe, bool on_a) { (on_a ? of_a : of_b) |= std::uint32_t{1} << (probe & 31); }
    [[nodiscard]] bool has(int probe, bool on_a) const { return (((on_a ? of_a : of_b) >> (probe & 31)) & 1) != 0; }
};

/// A direction of unit length; 0: none.
struct Axis
{
    double x = 0;
    double y = 0;

    [[nodiscard]] bool is_none() const { return x == 0 && y == 0; }
};

struct Touch
{
    double time = 0;
    double x = 0; ///< point of contact, in the coordinates of the paths
    double y = 0;
    double nx = 0; ///< unit normal from a to b
    double ny = 0;
    double distance = 0;     ///< the gap; negative: the leaves overlap
    double rate = 0;         ///< rate of the gap, m/s; negative: the leaves approach
    double acceleration = 0; ///< acceleration of the gap along the paths, m/s²; negative: the leaves press
    double curvature = 0;    ///< curvature of the surface as seen from the probe, see Surface
    int feature = 0;
    ProbeSet probes{}; ///< the corners that touch: one, or two on each other
};

/// Relative to the size: the greatest depth of a pressing contact before it touches anew.
inline constexpr double nearly_touch = 1e-3;

/// A pressing contact is resolved by micro-collisions. Their speed is the one that the acceleration causes in `wait` seconds, but at least `least_blow` unless
/// reaching that would take a depth of more than `depth`.
struct MicroCollision
{
    double wait = 0;
    double least_blow = 0; ///< m/s
    double depth = 0;      ///< m
};

/// Speed at which the gap closes after `wait`, limited by the depth nearly_touch; acceleration of the gap as in Touch.
[[nodiscard]] double pressed_speed(double acceleration, const MicroCollision& press, double length);

struct FlushNeighbours;

/// The flush neighbors of either leaf; null where there are none. See flush.h.
struct Flush
{
    const FlushNeighbours* of_a = nullptr;
    const FlushNeighbours* of_b = nullptr;

    [[nodiscard]] bool is_empty() const { return of_a == nullptr; }
};

/// The first time in [0, duration] at which the leaves touch and approach each other faster than least_approach. Leaves that overlap and
/// approach touch at 0; leaves that touch and separate do not touch until they come back. Pressing contacts touch anew by `press`. The corners of
/// `held` are left out. With `axis`, from a to b, corners on the far side are left out without a look. Adds the number of looks to `looks`.
[[nodiscard]] std::optional<Touch> first_touch(const LeafView& a, const FramePath& path_a, const LeafView& b,
                                               const FramePath& path_b, double duration, double least_approach,
                                               const MicroCollision& press = {}, const ProbeSet& held = {}, Axis axis = {},
                                               const Flush& flush = {}, std::int64_t* looks = nullptr);

/// True where the leaves cannot meet in that time: they stay apart along an axis from a to b. False says nothing.
[[nodiscard]] bool stay_apart(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b, Axis axis,
                              double duration);

/// True where the leaves are farther apart than `distance` along the axis at t = 0. False says nothing.
[[nodiscard]] bool are_apart(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b, Axis axis,
                             double distance);

/// Direction from the center that a turns about to that of b; none where they coincide.
[[nodiscard]] Axis line_of_centers(const FramePath& a, const FramePath& b);

/// The points at which the leaves are nearer than `tolerance` at t = 0, as far as there is room.
struct Touches
{
    static constexpr int capacity = 8;
    Touch list[capacity];
    int count = 0;

    [[nodiscard]] const Touch* begin() const { return list; }
    [[nodiscard]] const Touch* end() const { return list + count; }
};
[[nodiscard]] Touches touches_now(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b,
                                  double tolerance, const Flush& flush = {});

/// Characteristic size of a leaf, to which tolerances of distance are relative.
[[nodiscard]] double probe_size(const LeafView& v);

} // namespace carom::internal
