#pragma once

// Mass, center of mass and moment of inertia of a leaf, exact for every shape that has mass.

#include "geometry/leaf.h"

namespace carom::internal {

struct LeafMass
{
    double mass = 0;
    double center_x = 0;
    double center_y = 0;
    double inertia = 0; ///< about the center of mass
};

[[nodiscard]] LeafMass leaf_mass(const LeafView& view, float density);

} // namespace carom::internal
