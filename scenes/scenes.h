#pragma once

/// @file
/// Scenes that tests, benches and the lab share. Built through the public API alone; the same on every machine.

#include "carom/scene.h"

#include <functional>
#include <span>
#include <string_view>

namespace carom::scenes {

/// A scene and what drives it from outside.
struct BuiltScene
{
    Scene scene;
    std::function<void(Scene&, float h)> before_step{}; ///< may be empty; goes by time, so that shorter steps are the same scene

    const StepReport& step(float h)
    {
        if (before_step)
            before_step(scene, h);
        return scene.step(h);
    }
};

struct SceneEntry
{
    std::string_view name;        ///< lower case, no blanks
    std::string_view description; ///< one sentence: what is to be seen
    /// Builds the scene. The base gives what a scene does not care about (sub-steps, tasks, sleeping, ...).
    BuiltScene (*create)(const SceneDef& base);
    float h = 1.0f / 60;           ///< suggested step, s
    int frames = 600;              ///< suggested number of steps
    Box view{{-10, -1}, {10, 12}}; ///< what is worth seeing
    bool stands = false;           ///< built at rest: every movement is an error
};

/// Every scene, in a fixed order: the small ones first.
[[nodiscard]] std::span<const SceneEntry> all_scenes();
/// Those of at most some hundred bodies.
[[nodiscard]] std::span<const SceneEntry> small_scenes();
/// The ten of Box2D's benchmark program, two to twenty-two thousand bodies each, by name.
[[nodiscard]] std::span<const SceneEntry> benchmark_scenes();

/// Null where there is none of that name.
[[nodiscard]] const SceneEntry* find_scene(std::string_view name);

} // namespace carom::scenes
