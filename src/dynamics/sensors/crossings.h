#pragma once

// Trigger events from crossings of leaves.

#include "dynamics/state/scene_data.h"

namespace carom::internal {

/// Reports the crossings of this step as enter and exit events of shapes.
void report_crossings(StepContext& ctx);

} // namespace carom::internal
