#pragma once

#include "dynamics/step_context.h"

namespace carom::internal {

/// Before the first body of a step is asked for.
void forget_surroundings(StepContext& ctx);

/// How much of a body's displacement over the step (from its place in the records) is free of static shapes: 1 for all of it. For bodies
/// that were struck so hard in the step that they went beyond what their rows could see.
[[nodiscard]] double free_part_of_path(const StepContext& ctx, int body, double dx, double dy);

} // namespace carom::internal
