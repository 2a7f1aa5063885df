#pragma once

// Quarantine of bodies whose motion is no longer finite.

#include "dynamics/step_context.h"

#include <span>

namespace carom::internal {

/// Takes a body whose motion is no longer finite out of the simulation, at its last finite pose and at rest: its contacts end, it is
/// disabled and reported, and the rest of the world goes on.
void quarantine(StepContext& ctx, int body, float time);
/// Removes the step's events of these bodies: impacts, and touches that began in the step, together with their ends.
void forget_events_of(StepContext& ctx, std::span<const std::int32_t> bodies);

} // namespace carom::internal
