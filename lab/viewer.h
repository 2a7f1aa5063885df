#pragma once

/// @file
/// The window of carom-lab.

#include "scenes/scenes.h"

#include <string>

namespace carom::lab {

struct ViewerOptions
{
    const scenes::SceneEntry* entry = nullptr;
    int width = 1280;
    int height = 800;
    bool xray = false;
    std::string screenshot{}; ///< where set: take `steps` steps, write this PNG, end
    int steps = 0;
    int select = -1;  ///< the number of a body, with screenshot
    int substep = -1; ///< for a screenshot: look at this sub-step of the last step
};

/// Returns the program's exit code.
int run_viewer(const ViewerOptions& options);

} // namespace carom::lab
