#pragma once

/// @file
/// The elements of a table as geometry: what the checker measures.

#include "pinball/table/plane_geometry.h"
#include "pinball/table/table.h"

#include <vector>

namespace carom::pinball {

struct Obstacle
{
    Index element = none;
    std::vector<Curve> curves{};
    std::vector<Point> inside{}; ///< a polygon that is solid, empty where the curves are all there is
};

/// A flipper's bat at an angle: its two circles, its faces and what lies between them.
[[nodiscard]] std::vector<Curve> flipper_curves(const Flipper& flipper, double angle);
/// A box about a centre, its half sizes along `axis` turned by -90 degrees and along `axis`.
[[nodiscard]] std::vector<Curve> box_curves(Point center, Point half, Point axis);
[[nodiscard]] std::vector<Curve> plunger_curves(const Plunger& plunger, double pulled);
[[nodiscard]] std::vector<Curve> sprung_target_curves(const SprungTarget& target, double pushed);
/// Everything that a ball can touch, at rest, targets up. Captive balls are not among it.
[[nodiscard]] std::vector<Obstacle> obstacles_of(const Table& table);

/// Smallest clearance between two sets of curves.
[[nodiscard]] double clearance(const std::vector<Curve>& a, const std::vector<Curve>& b);
/// From a point to the nearest surface; negative inside a solid.
[[nodiscard]] double clearance(const Obstacle& obstacle, Point p);

template <typename Kind>
[[nodiscard]] const Kind* part_of(const Table& table, Index element)
{
    return std::get_if<Kind>(&table.elements[element].part);
}

} // namespace carom::pinball
