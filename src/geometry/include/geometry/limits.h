#pragma once

// How large, far and heavy a shape of a scene may be, so that boxes, masses and their inverses are finite floats.

#include "carom/shape.h"

namespace carom::internal {

/// Refuses in the caller's name; the geometry is normalized.
[[nodiscard]] bool check_reach(const char* function, const Geometry& geometry);
/// The same for the mass that the geometry has with this density.
[[nodiscard]] bool check_mass(const char* function, const Geometry& geometry, float density);

} // namespace carom::internal
