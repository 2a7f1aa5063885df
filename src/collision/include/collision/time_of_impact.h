#pragma once

// When do two leaves that move first touch? Both paths are exact functions of time: a point of the body along a parabola, and a turn about it
// with steady angular acceleration. All in double; the target is zero distance.
//
// Two leaves always touch at a corner of one: a circle, an end of a capsule, a vertex, the bulge of an arc. So a leaf is seen as a few
// probes, circles fixed to its body, and the question becomes when a probe meets the surface of the other leaf.

#include "carom/math.h"
#include "geometry/leaf.h"

#include <cmath>
#include <cstdint>
#include <optional>

namespace carom::internal {

/// By the square root, which every machine rounds alike; hypot is the library's affair.
[[nodiscard]] inline double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

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
    CenterPath center;   ///< of the point the body turns about: its center of mass, or a pivot
    Vec2 local_center{}; ///< where that is in the body's frame
    double c = 1;        ///< rotation at t = 0
    double s = 0;
    double w = 0;     ///< rad/s at t = 0
    double alpha = 0; ///< rad/s²
};

/// The same path seen from `time` on.
[[nodiscard]] FramePath path_after(const FramePath& path, double time);
/// The same path run backwards from t = 0.
[[nodiscard]] FramePath run_back(const FramePath& path);

/// Corners of both leaves, a bit each.
struct ProbeSet
{
    std::uint32_t of_a = 0;
    std::uint32_t of_b = 0;

    void add(int probe, bool on_a) { (on_a ? of_a : of_b) |= std::uint32_t{1} << (probe & 31); }
    [[nodiscard]] bool has(int probe, bool on_a) const { return (((on_a ? of_a : of_b) >> (probe & 31)) & 1) != 0; }
};

/// Of unit length; 0: none.
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
    double distance = 0;     ///< the gap; negative: they overlap
    double rate = 0;         ///< of the gap, m/s; negative: they approach
    double acceleration = 0; ///< of the gap while the paths go on, m/s²; negative: they press
    double curvature = 0;    ///< of the surface as seen from the probe, see Surface
    int feature = 0;
    ProbeSet probes{}; ///< the corners that touch: one, or two on each other
};

/// Of the size: so deep at the most comes what presses before it touches anew.
inline constexpr double nearly_touch = 1e-3;

/// What touches and presses is taken in blows: as fast as what presses makes it in `wait` seconds, but no slower than `least_blow` unless it would
/// come deeper than `depth` for that.
struct MicroCollision
{
    double wait = 0;
    double least_blow = 0; ///< m/s
    double depth = 0;      ///< m
};

/// How fast the gap closes by then, or once it is pressed as deep as nearly_touch; acceleration of the gap as in Touch.
[[nodiscard]] double pressed_speed(double acceleration, const MicroCollision& press, double length);

struct FlushNeighbours;

/// The flush neighbours of either leaf; null where it has none. See flush.h.
struct Flush
{
    const FlushNeighbours* of_a = nullptr;
    const FlushNeighbours* of_b = nullptr;

    [[nodiscard]] bool is_empty() const { return of_a == nullptr; }
};

/// The first time in [0, duration] at which the leaves touch and approach each other faster than least_approach. What overlaps and
/// approaches touches at 0; what touches and separates does not until it comes back. What presses touches anew by `press`. The corners of
/// `held` are left out. Along `axis`, from a to b, corners on the far side are told without a look. Adds the looks taken to `looks`.
[[nodiscard]] std::optional<Touch> first_touch(const LeafView& a, const FramePath& path_a, const LeafView& b,
                                               const FramePath& path_b, double duration, double least_approach,
                                               const MicroCollision& press = {}, const ProbeSet& held = {}, Axis axis = {},
                                               const Flush& flush = {}, std::int64_t* looks = nullptr);

/// True where nothing of the two can meet in that time: along an axis from a to b they stay apart. False says nothing.
[[nodiscard]] bool stay_apart(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b, Axis axis,
                              double duration);

/// True where they are farther apart than that along the axis at t = 0. False says nothing.
[[nodiscard]] bool are_apart(const LeafView& a, const FramePath& path_a, const LeafView& b, const FramePath& path_b, Axis axis,
                             double distance);

/// From the center that a turns about to that of b; none where they are in one place.
[[nodiscard]] Axis line_of_centers(const FramePath& a, const FramePath& b);

/// All points at which the leaves are nearer than `tolerance` at t = 0.
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

/// The nearest of a leaf's probes to zero size: what tolerances of distance are measured by.
[[nodiscard]] double probe_size(const LeafView& v);

} // namespace carom::internal
