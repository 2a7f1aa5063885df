#pragma once

// Steps that are not all alike. Impulses are kept from step to step, to start the next one with: they are those of a sub-step, and in another time the
// same forces give others. Those of a very short one are mostly noise, for a speed of 1 mm/s is as much as gravity gives in 0.1 ms. So the forces that are
// kept are averages over the longest sub-step of late, and stiffness goes by that, too.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Kept impulses become those of this step's sub-steps.
void begin_substeps(StepContext& ctx);

/// Before the solve, and after it. Where all sub-steps are alike there is nothing to do.
void note_forces(StepContext& ctx);
void average_forces(StepContext& ctx);

} // namespace carom::internal
