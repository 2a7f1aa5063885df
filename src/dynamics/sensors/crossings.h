#pragma once

// Trigger events from crossings of leaves.

#include "dynamics/state/scene_data.h"

namespace carom::internal {

/// What crossed in this step becomes enters and exits of shapes.
void report_crossings(StepContext& ctx);

} // namespace carom::internal
