#pragma once

// Constraints and joints of one island: from contacts and joint records to what the solver runs over, and back. It is done around the island's solve, so that a
// small island stays in the cache from its first constraint to its last impulse.

#include "core/worker_team.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// At the places that island_layout.h gave out; a large one by all of the worker team.
void fill_island(const StepContext& ctx, const Island& island, WorkerTeam& team);

/// Impulses and forces, to contacts and joints.
void commit_island(const StepContext& ctx, const Island& island, WorkerTeam& team);

/// Of a constraint that the island got while it was solved.
void commit_constraint(SceneState& state, const ContactConstraint& constraint);

} // namespace carom::internal
