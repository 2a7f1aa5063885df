#pragma once

/// @file
/// Closed rooms: what is inside must stay inside, whatever the walls are made of.

#include "property/pieces.h"

namespace carom::shots {

/// The inside of a convex polygon (counter-clockwise), or all points within a radius of a segment (two corners: a stadium, equal
/// ones: a disc). Always around the origin of its body.
struct Room
{
    std::vector<Point> corners{};
    double radius = 0;

    [[nodiscard]] bool round() const { return radius > 0; }
    /// How far the point is from the walls; negative outside.
    [[nodiscard]] double depth(Point p) const;
};

/// Rooms that a disc of this radius about the origin fits into.
[[nodiscard]] Room pick_polygon_room(Random& random, double inner);
[[nodiscard]] Room pick_wedge_room(Random& random, double inner); ///< a triangle with a sharp corner
[[nodiscard]] Room pick_round_room(Random& random, double inner);
[[nodiscard]] Room corridor(double half_length, double half_width);

/// Walls around the room, of segments, chains, boxes, capsules, half-spaces or arcs, in pieces of random length.
BodyId build_walls(Trial& trial, const Room& room, BodyType type = BodyType::Static, double spin = 0);

/// One straight wall along the x axis of its body, of any of these kinds; above it is free.
void build_lane(Trial& trial, BodyId body, double half_length, bool may_be_infinite);

/// The body's center of mass stays inside the room; the room stands at its body's origin and turns as told.
void expect_inside(Trial& trial, const Room& room, BodyId body, double spin = 0);

/// Where a disc of that radius that leaves the origin in that direction touches the walls.
[[nodiscard]] double way_to_walls(const Room& room, Point from, Point along, double radius);

} // namespace carom::shots
