#pragma once

// The stages of a step, in order. Each has a file of its own name; step.cpp calls them.

#include "dynamics/state/scene_data.h"
#include "dynamics/step_context.h"

namespace carom::internal {

const StepReport& step(SceneData& scene, float dt);

/// Wakes sleeping bodies that a new shape overlaps.
void wake_overlapped(StepContext& ctx);

/// Sets velocities of kinematic bodies with a target, and the boxes of moving bodies, wide enough for their paths in this step.
void sweep_paths(StepContext& ctx);

/// Finds new pairs of overlapping boxes.
void find_pairs(StepContext& ctx);

/// The second half of find_pairs: contacts of pairs that may meet in this step.
void follow_pairs(StepContext& ctx);

/// After the solve: contacts of triggers with bodies that flight moved beyond their boxes, or with triggers on such bodies.
void find_deflected_pairs(StepContext& ctx);

/// Updates the manifolds of awake contacts, begins and ends touches, and wakes touched bodies.
void update_contacts(StepContext& ctx);

/// Builds islands, states, colors and constraints.
void build_islands(StepContext& ctx);

/// Solves all sub-steps of all islands.
void solve_islands(StepContext& ctx);

/// Commits poses and velocities, deferred impulses, triggers and sleep.
void commit(StepContext& ctx);

/// The last part of commit: bodies come to rest, and islands fall asleep.
void settle_bodies(StepContext& ctx);

/// Marks the bodies whose paths update_triggers will need.
void mark_traced(StepContext& ctx);

/// Finds enter, inside and exit of trigger shapes along the paths of this step.
void update_triggers(StepContext& ctx);

/// Sorts the events of the step and makes the public ones of raw impacts and touches.
void publish_events(StepContext& ctx);

/// Reorders bodies and contacts for locality, now and then.
void reorder(StepContext& ctx);

/// Runs the user's callbacks from the events.
void run_callbacks(SceneData& scene, Scene& owner);

} // namespace carom::internal
