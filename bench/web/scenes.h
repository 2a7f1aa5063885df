#pragma once

/// @file
/// Scenes of the size that games in a browser have: a few hundred to two thousand bodies, nothing asleep.

#include "scenes/scenes.h"

#include <span>

namespace web {

/// The pyramid of 210 boxes, the tumbler of the ten scenes, and a pile of 2,000 discs, boxes, capsules and hexagons in a trough.
[[nodiscard]] std::span<const carom::scenes::SceneEntry> scenes();

} // namespace web
