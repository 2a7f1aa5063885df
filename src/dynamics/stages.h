#pragma once

// The stages of a step, in the order in which step.cpp calls them; parts of a stage follow it without a blank line.

#include "dynamics/state/scene_data.h"
#include "dynamics/step_context.h"

namespace carom::internal {

const StepReport& step(SceneData& scene, float dt);

/// Sweep: sets velocities of kinematic bodies with a target, and the boxes of moving bodies, wide enough for their paths in this step.
void sweep_paths(StepContext& ctx);
/// Wakes sleeping bodies that a new shape overlaps.
void wake_overlapped(StepContext& ctx);

/// Pairs: finds new pairs of overlapping boxes.
void find_pairs(StepContext& ctx);
/// Contacts of pairs that may meet in this step.
void follow_pairs(StepContext& ctx);

/// Contacts: updates the manifolds of awake contacts, begins and ends touches, and wakes touched bodies.
void update_contacts(StepContext& ctx);

/// Islands: builds islands, and gives states and colored constraints their slots.
void build_islands(StepContext& ctx);

/// Solve: all sub-steps of all islands.
void solve_islands(StepContext& ctx);
/// Marks the bodies whose paths update_triggers will need.
void mark_traced(StepContext& ctx);

/// Commit: poses and velocities, touches that began within the step, deferred impulses, triggers and sleep.
void commit(StepContext& ctx);
/// Finds enter, inside and exit of trigger shapes along the paths of this step.
void update_triggers(StepContext& ctx);
/// Contacts of triggers with bodies that flight moved beyond their boxes, or with triggers on such bodies.
void find_deflected_pairs(StepContext& ctx);
/// Bodies come to rest, and islands fall asleep.
void settle_bodies(StepContext& ctx);

/// Events: sorts the events of the step, and adds those that the user caused since the last one.
void publish_events(StepContext& ctx);

/// Reorders bodies and contacts for locality, now and then: see reorder.cpp.
void reorder(StepContext& ctx);

/// After the step: runs the user's callbacks from the events.
void run_callbacks(SceneData& scene, Scene& owner);

} // namespace carom::internal
