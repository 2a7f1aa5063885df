#pragma once

/// @file
/// A path of the file, ["M", x, y] ["L", x, y] ["A", cx, cy, r, from, to] ["Z"], as a chain of lines and true arcs.

#include "pinball/table/field_reader.h"

namespace carom::pinball {

/// An arc that misses the point where the path stands is snapped to it below this distance and refused above.
inline constexpr double snap_distance = 0.0001; ///< m

/// Reads the member "path" of a wall: open, at least one piece.
[[nodiscard]] Chain read_open_path(FieldReader& reader);
/// Reads the member "path" of a solid: ends in Z; the chain runs counter-clockwise whatever the file says.
[[nodiscard]] Chain read_closed_path(FieldReader& reader);

/// Signed area of a closed chain, arcs included; positive counter-clockwise.
[[nodiscard]] double signed_area(const Chain& chain);

} // namespace carom::pinball
