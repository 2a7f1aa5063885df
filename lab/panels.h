#pragma once

/// @file
/// The panels beside the picture: scenes, control, x-ray, numbers, sub-steps, the last impact.

#include "lab/run.h"
#include "view/window.h"
#include "view/xray.h"

#include <string>

namespace carom::lab {

/// The state that the panels read and change.
struct LabState
{
    const scenes::SceneEntry* wanted = nullptr; ///< a scene to load before the next frame; also the present one, to restart it
    SceneDef base{};                            ///< for the next start
    bool xray = false;
    BodyId selected{};    ///< whose story is told
    BodyId told{};        ///< whose story was told in the last frame
    std::string search{}; ///< in the names of scenes
    view::XrayOverlay overlay;
};

/// Draws the panels and gives what is left of the window for the picture, as a viewport in points.
struct Viewport
{
    Vec2 min{};
    Vec2 max{};
};
[[nodiscard]] Viewport picture_area(Vec2 window, bool xray);
void draw_panels(view::Window& window, Run& run, LabState& state);

} // namespace carom::lab
