#pragma once

// The stages of a step, in order. Each stands in a file of its own name; step.cpp is their table of contents.

#include "dynamics/state/scene_data.h"
#include "dynamics/step_context.h"

namespace carom::internal {

const StepReport& step(SceneData& scene, float dt);

/// Sleepers that a fresh shape overlaps.
void wake_overlapped(StepContext& ctx);

/// Velocities of kinematic bodies with a target; boxes of what moves, wide enough for its path in this step.
void sweep_paths(StepContext& ctx);

/// New pairs of overlapping boxes.
void find_pairs(StepContext& ctx);

/// The second half of it: contacts of those that may meet in this step.
void follow_pairs(StepContext& ctx);

/// After the solve: contacts of triggers with what flight threw beyond its box, or with triggers that it carries.
void find_deflected_pairs(StepContext& ctx);

/// Manifolds of awake contacts; begins and ends of touching; wakes what is touched.
void update_contacts(StepContext& ctx);

/// Islands, states, colours and constraints.
void build_islands(StepContext& ctx);

/// All sub-steps of all islands.
void solve_islands(StepContext& ctx);

/// New poses and velocities, deferred impulses, triggers, sleep.
void commit(StepContext& ctx);

/// The last of it: who comes to rest, and which islands fall asleep.
void settle_bodies(StepContext& ctx);

/// Whose paths update_triggers will ask for.
void mark_traced(StepContext& ctx);

/// Enter, inside and exit of trigger shapes along the paths of this step.
void update_triggers(StepContext& ctx);

/// Sorts the events of the step and makes the public ones of raw impacts and touches.
void publish_events(StepContext& ctx);

/// Puts bodies and contacts that are walked together side by side in memory, now and then.
void reorder(StepContext& ctx);

/// Runs the users' callbacks from the events.
void run_callbacks(SceneData& scene, Scene& owner);

} // namespace carom::internal
