#pragma once

#include "dynamics/step_context.h"

namespace carom::internal {

/// Takes a body whose motion is no longer finite out of the simulation, at its last finite pose and at rest: its contacts end, it is
/// disabled and reported, and the rest of the world goes on.
void quarantine(StepContext& ctx, int body, float time);

} // namespace carom::internal
