#pragma once

// What an island's constraints have stopped in a sub-step bounces, and is told.

#include "core/worker_team.h"
#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/step_context.h"

namespace carom::internal {

struct BouncingIsland
{
    const StepContext& ctx; ///< of the island's subdivisions
    const Island& island;
    IslandOutput& output;
    const SolverView& view;
    bool notes_pushes; ///< it warm starts by body: what is pushed beside the constraints must not be taken for what they give
};

/// Of constraints that bear nothing yet, before the sub-step.
void note_approaches(const BouncingIsland& island);

/// At the end of sub-step k.
void bounce(const BouncingIsland& island, int k, WorkerTeam& team);

} // namespace carom::internal
