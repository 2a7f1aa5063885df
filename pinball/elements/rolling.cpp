#include "pinball/elements/rolling.h"

#include <algorithm>

namespace carom::pinball {

Vec2 playfield_friction(Vec2 velocity, Vec2 rolling, Vec2 slope, float greatest, float h)
{
    const Vec2 slip = velocity - rolling + h * slope;
    const Vec2 stop = (-2.0f / (7.0f * h)) * slip;
    const float wanted = length(stop);
    return wanted <= greatest ? stop : (greatest / wanted) * stop;
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
