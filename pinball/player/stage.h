#pragma once

/// @file
/// One frame: table, score, panels, x-ray.

#include "pinball/player/machine.h"
#include "pinball/player/score_panel.h"
#include "pinball/player/table_camera.h"
#include "pinball/player/workshop.h"
#include "pinball/player/xray_panel.h"
#include "view/window.h"

namespace carom::pinball {

struct Frame
{
    float alpha = 1;
    bool xray = false;
    const char* question = nullptr; ///< that waits for an answer
    Status status{};
};

/// State that drawing keeps from frame to frame.
struct Stage
{
    TableCamera camera{};
    view::Camera seen{}; ///< through which the table was drawn last
    XrayPanel xray{};
    Workshop workshop{};
};

void draw_frame(view::Window& window, Machine& machine, Stage& stage, const Frame& frame);

} // namespace carom::pinball
