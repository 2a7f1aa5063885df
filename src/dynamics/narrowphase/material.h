#pragma once

// The contact law: how the materials of two shapes determine friction, restitution and kick. Contact constraints and flight use the same functions.

#include "dynamics/state/scene_data.h"

namespace carom::internal {

[[nodiscard]] float mixed_friction(const SceneData& scene, int shape_a, int shape_b);

/// Restitution at an approach speed, curves included.
[[nodiscard]] float mixed_restitution(const SceneData& scene, int shape_a, int shape_b, float approach_speed);

/// With less, an impact gives back less than a tenth of its energy.
inline constexpr float bouncing_restitution = 0.316f;

/// True if an impact of the two may give back a tenth of its energy or more, at any approach speed: when it happens then matters to all that follows.
[[nodiscard]] bool may_bounce(const SceneData& scene, int shape_a, int shape_b);

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
