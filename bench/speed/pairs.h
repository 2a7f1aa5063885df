#pragma once

/// @file
/// Which shapes of a scene are near each other.

#include "carom/scene.h"
#include "truth/overlap.h"

#include <functional>
#include <vector>

namespace speed {

/// Calls back with the overlap of every pair of shapes that may touch and are nearer than a margin: negative where they are apart.
void for_near_pairs(carom::Scene& scene, const std::vector<truth::State>& states, double margin,
                    const std::function<void(double overlap)>& found);

} // namespace speed
