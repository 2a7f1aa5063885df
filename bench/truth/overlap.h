#pragma once

/// @file
/// How deep two bodies are in each other, from their poses alone: the engines' own answers are not asked.

#include "truth/world.h"

namespace truth {

/// A shape where it stands.
struct Placed
{
    Shape shape{};
    Vec position{};
    double angle = 0;
};

/// The same in world coordinates: the convex hull of its corners, counter-clockwise, grown by a radius. A disc has one corner, a
/// segment or capsule two.
struct Hull
{
    std::vector<Vec> corners{};
    double radius = 0;
};
[[nodiscard]] Hull hull(const Placed& placed);

/// Least distance by which they would have to part, m; negative or 0 where they do not overlap.
[[nodiscard]] double overlap(const Hull& a, const Hull& b);
[[nodiscard]] double overlap(const Placed& a, const Placed& b);

/// Radius about the position that holds all of it.
[[nodiscard]] double reach(const Shape& shape);

} // namespace truth
