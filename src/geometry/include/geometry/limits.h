#pragma once

// Limits on the size, distance and mass of a shape of a scene, so that boxes, masses and their inverses are finite floats.

#include "carom/shape.h"

namespace carom::internal {

/// Refuses a normalized geometry that is too large or too far, in the caller's name.
[[nodiscard]] bool check_reach(const char* function, const Geometry& geometry);
/// The same for the mass and the moment of inertia that the geometry has with this density.
[[nodiscard]] bool check_mass(const char* function, const Geometry& geometry, float density);

} // namespace carom::internal
