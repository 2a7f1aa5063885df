#pragma once

// Bodies in free flight: exact paths, exact times of impact, exact impulses, within a sub-step of an island.

#include "core/worker_team.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Before sub-step k: landed fliers that have become fast take off.
void take_off_fast_movers(StepContext& ctx, const Island& island, int k, IslandOutput& output);

/// Moves the island's fliers through sub-step k, impact by impact, after the solver has moved all other bodies. A flier that comes to rest
/// is solver-owned from the next sub-step on; its constraints go to output.late_constraints.
void advance_fliers(StepContext& ctx, const Island& island, int k, IslandOutput& output, WorkerTeam& team);

/// Moves an island through the whole step at once if all its bodies are in free flight and meet nothing. False: nothing has moved.
[[nodiscard]] bool fly_whole_step(const StepContext& ctx, const Island& island, IslandOutput& output, WorkerTeam& team);

/// Marks a flier as deflected: its path is no longer the one with which the pairs of this step were found.
void note_deflected(Scratch& scratch, IslandOutput& output, std::int32_t flier);

/// Records the paths near triggers, as advance_fliers does, for an island without fliers.
void trace_paths(StepContext& ctx, const Island& island, int k, IslandOutput& output);

} // namespace carom::internal
