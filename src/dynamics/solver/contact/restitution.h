#pragma once

// What a unit's rows have stopped in a sub-step bounces, and is told.

#include "core/crew.h"
#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/step_context.h"

namespace carom::internal {

struct BouncingUnit
{
    const StepContext& ctx; ///< of the unit's slices
    const Unit& unit;
    UnitOutput& output;
    const SolverView& view;
    bool notes_pushes; ///< it warm starts by body: what is pushed beside the rows must not be taken for what they give
};

/// Of rows that bear nothing yet, before the sub-step.
void note_approaches(const BouncingUnit& unit);

/// At the end of sub-step k.
void bounce(const BouncingUnit& unit, int k, Crew& crew);

} // namespace carom::internal
