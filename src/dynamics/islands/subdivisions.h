#pragma once

// Number of subdivisions of an island's sub-steps.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Finds the subdivisions of each tally, so that normals of contacts and arms of joints turn by a small angle in each. Also counts joints.
void find_subdivisions(StepContext& ctx);

} // namespace carom::internal
