#pragma once

/// @file
/// Shared by the ten scenes of Box2D 3.2's benchmark program (MIT), rebuilt from their measures: 1/60 s and 4 sub-steps, the same bodies,
/// shapes, materials, filters and schedule, so that times can be compared.

#include "scenes/build.h"

namespace carom::scenes {

/// Common to all ten: Box2D's gravity, and the greater restitution of a pair.
inline SceneDef benchmark_def(const SceneDef& base)
{
    SceneDef def = base;
    def.gravity = {0, -10};
    def.restitution_rule = MixRule::Maximum;
    return def;
}

/// The pyramids and the grid stay awake.
inline SceneDef sleepless_def(const SceneDef& base)
{
    SceneDef def = benchmark_def(base);
    def.sleeping = false;
    return def;
}

/// Rows of boxes, one fewer in each; left is the outer edge of the lowest row.
void add_pyramid(Scene& scene, int rows, float half, float left, float bottom);

} // namespace carom::scenes
