#pragma once

#include "core/crew.h"
#include "dynamics/solver/island_energy.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// All sub-steps of a unit whose rows are filled. `energy` is memory; `crew` shares a large unit's work.
void solve_unit(const StepContext& ctx, const Unit& unit, UnitOutput& output, UnitEnergy& energy, Crew& crew);

} // namespace carom::internal
