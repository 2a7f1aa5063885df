#pragma once

/// @file
/// The pile of boxes and discs that --scaling and --flight time.

#include "scenes/build.h"

namespace speed {

inline constexpr float dt = 1.0f / 60; ///< s, of a step
inline constexpr int pile_rows = 20;
inline constexpr float pile_pitch = 0.51f; ///< of bodies of half a metre

/// The i-th: every third is a disc.
void add_piece(carom::Scene& scene, carom::Position at, int i, const carom::ShapeDef& shape = {});

/// Half of what so many bodies take, one column beside the other.
[[nodiscard]] float pile_half_width(int bodies);

/// In a trough with walls so high.
void build_pile(carom::Scene& scene, int bodies, float wall_height);

} // namespace speed
