#pragma once

// Bodies in free flight: exact paths, exact times of impact, exact impulses, within a sub-step of a unit.

#include "core/crew.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Before sub-step k: what could fly and has become fast does so from here on.
void raise_fast(StepContext& ctx, const Unit& unit, int k, UnitOutput& output);

/// Flies the unit's bodies in flight through sub-step k, impact by impact, after the solver has moved everything else. What comes to rest against
/// something becomes the solver's from the next sub-step on; its rows go to output.late_rows.
void advance_fliers(StepContext& ctx, const Unit& unit, int k, UnitOutput& output, Crew& crew);

/// Where all of the unit flies freely, and none of it meets anything in this step, flies it through the whole step at once. False: nothing has moved.
[[nodiscard]] bool glide(const StepContext& ctx, const Unit& unit, UnitOutput& output);

/// It is no longer on the way that the pairs of this step were found with.
void note_deflected(Scratch& scratch, UnitOutput& output, std::int32_t flier);

/// What advance_fliers writes down of the paths near triggers, for a unit where nothing flies.
void trace_paths(StepContext& ctx, const Unit& unit, int k, UnitOutput& output);

} // namespace carom::internal
