#pragma once

/// @file
/// A scene for engines that are fed by run.mjs.

#include "scenes/scenes.h"

#include <string>

namespace web {

inline constexpr int warm_up = 300; ///< steps in which a browser's compiler is still at work

/// JSON: bodies with their shapes and materials, hinges with motors, the step and how many. Where the engine has exceptions.
[[nodiscard]] std::string describe(const carom::scenes::SceneEntry& entry);

} // namespace web
