#pragma once

/// @file
/// The shot and the obstacles: random shapes, materials, and their outlines.

#include "property/trial.h"

namespace carom::shots {

/// A convex shape centered on its body's origin.
struct Piece
{
    Geometry geometry{};
    Outline outline{};
    double inner = 0; ///< radius of the largest disc about the origin inside it, m
    double reach = 0; ///< radius of the smallest disc about the origin around it, m
};

[[nodiscard]] double log_uniform(Random& random, double low, double high);
/// Now and then exactly 0 or exactly 1, else anything between.
[[nodiscard]] float fraction(Random& random);
/// 5 mm to 1 m, each decade as likely.
[[nodiscard]] double pick_size(Random& random);
/// Two fifths to two and a half times the size, 5 mm to 1 m.
[[nodiscard]] double pick_size_near(Random& random, double size);
/// 0.001 to 1,000 m/s, each decade as likely.
[[nodiscard]] double pick_speed(Random& random);
[[nodiscard]] Point pick_direction(Random& random);
[[nodiscard]] Point pick_velocity(Random& random, double slowest, double fastest);
[[nodiscard]] double pick_sign(Random& random, double positive);
/// None, or 9.81 m/s² in any direction.
[[nodiscard]] Point pick_gravity(Random& random);
[[nodiscard]] ShapeDef pick_material(Random& random);

[[nodiscard]] Piece make_ball(double radius);
[[nodiscard]] Piece pick_long_piece(Random& random, double reach); ///< anything but a ball
[[nodiscard]] Piece pick_piece(Random& random, double reach);

/// Adds the piece as a body and tells the story of it.
BodyId add_piece(Trial& trial, const Piece& piece, BodyType type, Point at, double angle, Point velocity, double spin,
                 MotionLocks locks = {});
/// A dynamic piece at a random angle, spinning up to 50 rad/s where it is no ball at rest.
BodyId shoot(Trial& trial, const Piece& piece, Point at, Point velocity);

/// A body that bounces off something convex and then flies straight stays outside of the tangent at the meeting; n points outwards. A way
/// into it that is a small part of the way since the meeting has strayed, more has passed through.
void expect_outside(Trial& trial, Point n, double allowed, std::function<Point()> since_meeting);

/// How many steps bring the shot from a gap to its target and a few further.
void pick_steps(Trial& trial, double gap, double speed, int further);
/// A gap that the shot crosses in up to four steps, no larger than the limit.
[[nodiscard]] double pick_gap(Trial& trial, double speed, double limit);

} // namespace carom::shots
