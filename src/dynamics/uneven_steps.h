#pragma once

// Steps of different lengths. Impulses are kept from step to step for warm starting. They belong to a sub-step: in another time the same
// forces give other impulses. Impulses of a very short sub-step are mostly noise, for a speed of 1 mm/s is as much as gravity gives in
// 0.1 ms. So the forces that are kept are averages over the longest recent sub-step, and stiffness depends on it, too.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Converts the kept impulses to this step's sub-steps.
void begin_substeps(StepContext& ctx);

/// Called before the solve and after it. They do nothing if the sub-step is the longest recent one.
void save_impulses(StepContext& ctx);
void average_saved_impulses(StepContext& ctx);

} // namespace carom::internal
