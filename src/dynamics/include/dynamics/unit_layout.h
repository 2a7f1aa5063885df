#pragma once

// States, rows and joints of the step's units side by side: the second half of the units stage.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Fills the arrays of Scratch that the solver runs over.
void lay_out_units(StepContext& ctx);

/// The same for units whose places are those of the last step.
void refill_units(StepContext& ctx);

} // namespace carom::internal
