#pragma once

/// @file
/// Distances as they are found at school: what the chapter on pairs draws. The engine's own functions do the same for any polygon.

#include "carom/math.h"

#include <array>
#include <utility>

namespace carom::tour::school {

/// The height of a point over a plane through a point, m; negative below.
[[nodiscard]] float above_plane(Position point, Position on_plane, Vec2 normal);

[[nodiscard]] std::array<Position, 4> corners(const Pose& pose, Vec2 half);

struct Nearest
{
    Vec2 local;     ///< the point in the box's frame
    Vec2 clamped;   ///< the nearest point of the box, there
    float distance; ///< m; negative inside: to the nearest side
};
[[nodiscard]] Nearest nearest_in_box(Position point, const Pose& box, Vec2 half);

/// A side's direction: 0 along x, 1 along y of the box's frame.
[[nodiscard]] Vec2 axis(const Pose& pose, int which);
/// From where to where a box reaches along a direction from the world's origin, m.
[[nodiscard]] std::pair<float, float> shadow(Vec2 axis, const Pose& pose, Vec2 half);
/// Between the shadows of two boxes, m; negative: they overlap by that much.
[[nodiscard]] float gap_along(Vec2 axis, const Pose& a, Vec2 half_a, const Pose& b, Vec2 half_b);

} // namespace carom::tour::school
