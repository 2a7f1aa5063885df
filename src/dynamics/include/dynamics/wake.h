#pragma once

// Sleep and waking. An island sleeps and wakes as a whole; while it sleeps its boxes rest in the other layer and its contacts keep their
// manifolds and impulses untouched.

#include "dynamics/scene_data.h"

namespace carom::internal {

[[nodiscard]] inline bool is_awake(const SceneState& state, int body) { return state.bodies[body].awake_index != none; }

/// Wakes the body and everything that touches or is joined to it through dynamic bodies. Static and disabled bodies stay.
void wake_body(SceneData& scene, int body);

/// Puts one body to sleep: the caller takes care of the rest of its island.
void sleep_body(SceneData& scene, int body);

/// The bodies of the island that holds this one, itself first.
[[nodiscard]] std::vector<std::int32_t> island_of(const SceneState& state, int body);

/// Takes a body into the simulation or out of it, without touching its neighbours: lists and layers only.
void enter_awake(SceneData& scene, int body);
void leave_awake(SceneData& scene, int body);

} // namespace carom::internal
