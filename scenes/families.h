#pragma once

/// @file
/// The scenes by family; registry.cpp puts them together.

#include "scenes/scenes.h"

#include <span>

namespace carom::scenes {

[[nodiscard]] std::span<const SceneEntry> stacking_scenes();
[[nodiscard]] std::span<const SceneEntry> pile_scenes();
[[nodiscard]] std::span<const SceneEntry> joint_scenes();
[[nodiscard]] std::span<const SceneEntry> surface_scenes();
[[nodiscard]] std::span<const SceneEntry> motion_scenes();
[[nodiscard]] std::span<const SceneEntry> benchmark_pile_scenes();
[[nodiscard]] std::span<const SceneEntry> benchmark_joint_scenes();
[[nodiscard]] std::span<const SceneEntry> benchmark_drum_scenes();

} // namespace carom::scenes
