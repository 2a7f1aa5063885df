#pragma once

// Balls in free flight: exact paths, exact times of impact, exact impulses, within a sub-step of a unit.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Flies the unit's balls through sub-step k, impact by impact, after the solver has moved everything else. Balls that come to rest against
/// something become the solver's from the next sub-step on; their rows go to output.late_rows.
void advance_fliers(StepContext& ctx, const Unit& unit, int k, UnitOutput& output);

} // namespace carom::internal
