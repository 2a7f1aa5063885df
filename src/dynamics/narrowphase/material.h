#pragma once

// The contact law: how the materials of two shapes determine friction, restitution and kick. Contact constraints and flight use the same functions.

#include "dynamics/state/scene_data.h"

namespace carom::internal {

[[nodiscard]] float mixed_friction(const SceneData& scene, int shape_a, int shape_b);

/// Restitution at an approach speed, curves included.
[[nodiscard]] float mixed_restitution(const SceneData& scene, int shape_a, int shape_b, float approach_speed);

/// Speed that kicks add at this approach speed, and which shapes fired.
struct KickResult
{
    float speed = 0;
    bool a_fired = false;
    bool b_fired = false;
};
[[nodiscard]] KickResult kick_speed(const SceneData& scene, int shape_a, int shape_b, float approach_speed);

/// A one-way shape lets bodies pass from behind: does the contact with this normal (world, a to b) let b pass?
[[nodiscard]] bool lets_pass(const SceneData& scene, int shape_a, int shape_b, Vec2 normal);

} // namespace carom::internal
