#pragma once

/// @file
/// Shapes and whole scenes, drawn through the public API.

#include "view/canvas.h"

#include "carom/scene.h"

namespace carom::view {

/// How one shape is drawn. Things without an inside (segment, arc, chain) are lines of their real thickness.
struct ShapeLook
{
    Color fill{};
    Color edge{};
    float edge_width = 1.5f;   ///< points
    float least_thickness = 3; ///< of lines, points
    bool dashed = false;       ///< edges only, dashed: triggers
    bool spoke = true;         ///< circles show how they turn
};

void draw_shape(Canvas& canvas, const Geometry& geometry, const Pose& pose, const ShapeLook& look);

/// The colours of draw_scene.
struct ScenePalette
{
    Color still = rgb(0x46536b);
    Color kinematic = rgb(0x5fb98e);
    Color dynamic[5] = {rgb(0xe9a23b), rgb(0xd9694f), rgb(0x4f9fd9), rgb(0xb07fd6), rgb(0x6fc3b2)};
    Color trigger = rgb(0xd67fc0);
    Color joint = rgb(0xa9b6cc);
    float asleep = 0.45f; ///< share of the colour that is left while a body sleeps
};

/// Every body as it lies `alpha` of the way from the step before to the last one, and the joints. Bodies that are out of
/// sight cost little.
void draw_scene(Canvas& canvas, const Scene& scene, float alpha = 1, const ScenePalette& palette = {});

/// The outlines of one body's shapes at another pose than its own.
void draw_ghost(Canvas& canvas, const Scene& scene, BodyId body, const Pose& pose, const Pen& pen);

} // namespace carom::view
