#include "pinball/elements/rolling.h"

#include <algorithm>

namespace carom::pinball {

Vec2 playfield_friction(Vec2 velocity, Vec2 rolling, Vec2 slope, float greatest, float h)
{
    const Vec2 slip = velocity - rolling;
    const Vec2 stop = (-2.0f / (7.0f * h)) * (slip + h * slope);
    if (length(stop) <= greatest)
        return stop;
    // Friction works along the slip and does not turn it; the slope does: its way half through is the mean.
    const Vec2 mean = slip + (0.5f * h) * slope;
    const float speed = length(mean);
    return speed > 0 ? (-greatest / speed) * mean : Vec2{};
}

Vec2 rolling_after(Vec2 rolling, Vec2 friction, float h) { return rolling - (2.5f * h) * friction; }

// The face slides at s = rolling · n. An impulse p per mass changes s by 5/2 p through the spin; were the ball free to
// hop, its height would take another p, and the grip would leave 2/7 of s. The hop itself is not followed.
Vec2 rub_wall(Vec2 rolling, Vec2 normal, float room)
{
    const float slip = dot(rolling, normal);
    const float grip = (2.0f / 7.0f) * slip;
    return rolling - (2.5f * std::clamp(grip, -room, room)) * normal;
}

void rub_balls(Vec2& rolling_a, Vec2& rolling_b, Vec2 normal, float room)
{
    const float slip = dot(rolling_a + rolling_b, normal);
    const float grip = (1.0f / 7.0f) * slip;
    const Vec2 change = (2.5f * std::clamp(grip, -room, room)) * normal;
    rolling_a -= change;
    rolling_b -= change;
}

} // namespace carom::pinball
