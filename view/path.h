#pragma once

/// @file
/// Curves as points: outlines of round things, fine enough that no corner shows.

#include "carom/math.h"
#include "carom/shape.h"

#include <span>
#include <vector>

namespace carom::view {

using Path = std::vector<Position>;

/// Appends points of an arc, both ends included. tolerance: how far chords may lie from the arc, m.
void append_arc(Path& path, Position center, float radius, float start_angle, float sweep, float tolerance);

/// The outline of a capsule with two radii, counter-clockwise.
[[nodiscard]] Path capsule_outline(Position a, Position b, float radius_a, float radius_b, float tolerance);

/// The outline of a convex polygon whose corners are rounded outwards, counter-clockwise.
[[nodiscard]] Path rounded_outline(std::span<const Position> vertices, float radius, float tolerance);

/// The middle line of a chain, in its own frame; a closed chain does not repeat its start.
[[nodiscard]] Path chain_path(const Chain& chain, float tolerance);

/// Puts every point through a pose.
void transform_path(Path& path, const Pose& pose);

} // namespace carom::view
