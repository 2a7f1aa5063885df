#pragma once

// Contact constraints and joints of one island: filled from contacts and joint records, and committed back. This is done just before
// and after the island is solved, so that a small island stays in the cache from its first constraint to its last impulse.

#include "core/worker_team.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Fills the slots that island_layout.h assigned; the whole worker team fills a large island.
void fill_island(const StepContext& ctx, const Island& island, WorkerTeam& team);

/// Writes impulses and forces back to contacts and joints.
void commit_island(const StepContext& ctx, const Island& island, WorkerTeam& team);

/// Commits a constraint that the island got while it was solved.
void commit_constraint(SceneState& state, const ContactConstraint& constraint);

} // namespace carom::internal
