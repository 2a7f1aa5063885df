#include "tour/chapters/school_geometry.h"

#include <algorithm>
#include <cmath>

namespace carom::tour::school {

float above_plane(Position point, Position on_plane, Vec2 normal) { return dot(point - on_plane, normal); }

std::array<Position, 4> corners(const Pose& pose, Vec2 half)
{
    return {transform(pose, {-half.x, -half.y}), transform(pose, {half.x, -half.y}), transform(pose, half),
            transform(pose, {-half.x, half.y})};
}

Nearest nearest_in_box(Position point, const Pose& box, Vec2 half)
{
    const Vec2 local = inverse_rotate(box.rotation, point - box.position);
    const Vec2 clamped{std::clamp(local.x, -half.x, half.x), std::clamp(local.y, -half.y, half.y)};
    if (clamped != local)
        return {local, clamped, length(local - clamped)};
    const float to_side_x = half.x - std::abs(local.x);
    const float to_side_y = half.y - std::abs(local.y);
    const Vec2 on_side = to_side_x < to_side_y ? Vec2{std::copysign(half.x, local.x), local.y} : Vec2{local.x, std::copysign(half.y, local.y)};
    return {local, on_side, -std::min(to_side_x, to_side_y)};
}

Vec2 axis(const Pose& pose, int which) { return rotate(pose.rotation, which == 0 ? Vec2{1, 0} : Vec2{0, 1}); }

std::pair<float, float> shadow(Vec2 axis, const Pose& pose, Vec2 half)
{
    const float middle = dot(pose.position - Position{}, axis);
    const float reach = half.x * std::abs(dot(school::axis(pose, 0), axis)) + half.y * std::abs(dot(school::axis(pose, 1), axis));
    return {middle - reach, middle + reach};
}

float gap_along(Vec2 axis, const Pose& a, Vec2 half_a, const Pose& b, Vec2 half_b)
{
    const auto [low_a, high_a] = shadow(axis, a, half_a);
    const auto [low_b, high_b] = shadow(axis, b, half_b);
    return std::max(low_b - high_a, low_a - high_b);
}

} // namespace carom::tour::school
