#pragma once

#include "core/worker_team.h"
#include "dynamics/solver/island_energy.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// All sub-steps of an island whose constraints are filled. `energy` is memory; `worker team` shares a large island's work.
void solve_island(const StepContext& ctx, const Island& island, IslandOutput& output, IslandEnergy& energy, WorkerTeam& team);

} // namespace carom::internal
