#pragma once

/// @file
/// The ball is a sphere on a plane. The scene knows its position, its velocity and its spin about the axis that points
/// up from the playfield; the other two spins live here, as the velocity `rolling` at which the ball would roll without
/// sliding (spin about the table's axes times radius).
///
/// The point of the ball that touches the playfield slides with u = velocity - rolling. Friction of at most mu m g cos(slope)
/// works against u: it changes the velocity by a h and, since the inertia is 2/5 m r², the rolling by -5/2 a h, hence the
/// slip by 7/2 a h. From rest that gives 5/7 g sin(slope); from a slide it ends in rolling at 5/7 of the speed.

#include "carom/force_law.h"
#include "carom/math.h"

namespace carom::pinball {

/// The surface on which a ball rolls.
struct Floor
{
    Vec2 slope{};       ///< acceleration down the table, m/s²
    float friction = 0; ///< greatest deceleration by the playfield, m/s²
    float ball_mass = 0;
};

/// Acceleration that the playfield's friction gives over a time h: what ends the slip within it, or what the
/// friction can give at most. `slope` is the acceleration that gravity adds meanwhile.
[[nodiscard]] Vec2 playfield_friction(Vec2 velocity, Vec2 rolling, Vec2 slope, float greatest, float h);

/// The rolling after that friction acted for h.
[[nodiscard]] Vec2 rolling_after(Vec2 rolling, Vec2 friction, float h);

/// A wall that is struck rubs on the spin that rolls the ball at it: its face slides up or down along the wall. The
/// impulse left over from the sideways friction works on it until it grips. `room` is that impulse over the ball's mass, m/s.
[[nodiscard]] Vec2 rub_wall(Vec2 rolling, Vec2 normal, float room);

/// The same between two balls: their facing sides slide against each other. The normal points from a to b.
void rub_balls(Vec2& rolling_a, Vec2& rolling_b, Vec2 normal, float room);

} // namespace carom::pinball
