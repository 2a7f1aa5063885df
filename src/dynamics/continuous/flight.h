#pragma once

// Bodies in free flight: exact paths, exact times of impact, exact impulses, within a sub-step of an island.

#include "core/worker_team.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Before sub-step k: what could fly and has become fast does so from here on.
void take_off_fast_movers(StepContext& ctx, const Island& island, int k, IslandOutput& output);

/// Flies the island's bodies in flight through sub-step k, impact by impact, after the solver has moved everything else. What comes to rest against
/// something becomes the solver's from the next sub-step on; its constraints go to output.late_constraints.
void advance_fliers(StepContext& ctx, const Island& island, int k, IslandOutput& output, WorkerTeam& team);

/// Where all of the island flies freely, and none of it meets anything in this step, flies it through the whole step at once. False: nothing has moved.
[[nodiscard]] bool fly_whole_step(const StepContext& ctx, const Island& island, IslandOutput& output);

/// It is no longer on the way that the pairs of this step were found with.
void note_deflected(Scratch& scratch, IslandOutput& output, std::int32_t flier);

/// What advance_fliers writes down of the paths near triggers, for an island where nothing flies.
void trace_paths(StepContext& ctx, const Island& island, int k, IslandOutput& output);

} // namespace carom::internal
