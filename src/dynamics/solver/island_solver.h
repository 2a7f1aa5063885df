#pragma once

// The solver of one island.

#include "core/worker_team.h"
#include "dynamics/solver/energy/island_energy.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Takes an island whose constraints are filled through all its sub-steps. `energy` is memory; `team` shares a large island's work.
void solve_island(const StepContext& ctx, const Island& island, IslandOutput& output, IslandEnergy& energy, WorkerTeam& team);

} // namespace carom::internal
