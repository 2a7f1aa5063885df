#pragma once

/// @file
/// Round shapes as polygons of at most eight corners, for engines that have no others.

#include "truth/world.h"

namespace truth {

/// Corners on the capsule's outline, four at each end.
[[nodiscard]] Polygon facets(const Capsule& capsule);
/// A rounded polygon's edges moved outwards by its radius, and extended to sharp corners.
[[nodiscard]] std::vector<Vec> grown(const Polygon& polygon);

} // namespace truth
