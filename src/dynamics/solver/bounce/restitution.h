#pragma once

// Impacts that an island's constraints have stopped in a sub-step: they bounce and are reported.

#include "core/worker_team.h"
#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/step_context.h"

namespace carom::internal {

struct BouncingIsland
{
    const StepContext& ctx; ///< with the island's subdivision of sub-steps
    const Island& island;
    IslandOutput& output;
    const SolverView& view;
    DirectSolve* joints;   ///< through which contacts bounce; null if no joints are solved directly, or they yield
    double kinetic_before; ///< energy of the island before it was stopped, J; where contacts bounce through joints
    bool notes_pushes;     ///< it warm starts by body: impulses beside the constraints must not count as theirs
};

/// Notes the approach speeds of constraints that bear no load yet, before the sub-step.
void note_approaches(const BouncingIsland& island);

/// Called once forces and joints, but no contacts yet, have changed the speeds: an approach is that at which the bodies meet within the sub-step.
void carry_approaches_on(const BouncingIsland& island);

/// Called at the end of sub-step k.
void bounce(const BouncingIsland& island, int k, WorkerTeam& team);

} // namespace carom::internal
