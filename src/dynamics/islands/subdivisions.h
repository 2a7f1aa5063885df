#pragma once

#include "dynamics/step_context.h"

namespace carom::internal {

/// Of each tally: normals of contacts that turn with a bar or a bat, and arms of joints, turn by little in each sub-step. Also counts joints.
void find_subdivisions(StepContext& ctx);

} // namespace carom::internal
