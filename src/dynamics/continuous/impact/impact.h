#pragma once

// An impact in flight: who takes part, what they do to each other, and what rests against what afterwards.

#include "dynamics/continuous/motion.h"

namespace carom::internal {

/// Resolves what touches at the time of the flier's event, the event's own contact and all that hangs together with it through bodies in
/// flight. Appends the states whose paths have changed.
void resolve_impact(const FlightSpan& span, Flier& first, std::vector<std::int32_t>& changed);

} // namespace carom::internal
