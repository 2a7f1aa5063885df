#pragma once

/// @file
/// A figure of eleven bones on ten hinges with limits, springs and friction.

#include "scenes/scenes.h"

#include <array>

namespace carom::scenes {

/// Its bones, the hip first.
using Ragdoll = std::array<BodyId, 11>;

/// Stands with its feet at the position. Figures of the same number (1 and up) pass through each other.
[[nodiscard]] Ragdoll add_ragdoll(Scene& scene, Vec2 feet, int number);
void destroy_ragdoll(Scene& scene, const Ragdoll& ragdoll);

} // namespace carom::scenes
