#pragma once

/// @file
/// A scene without a window: steps, and one JSON object of what came out.

#include "scenes/scenes.h"

#include <string>

namespace carom::lab {

struct HeadlessRun
{
    const scenes::SceneEntry* entry = nullptr;
    int steps = 0;
    float h = 0; ///< s; 0: the scene's own
    SceneDef base{};
};

/// One JSON object on one line. Shows progress where stderr is a terminal; Ctrl-C ends early and reports what was done.
[[nodiscard]] std::string run_headless(const HeadlessRun& run);

} // namespace carom::lab
