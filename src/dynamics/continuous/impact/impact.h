#pragma once

// An impact in flight: the bodies involved, their impulses, and the resting contacts afterwards.

#include "dynamics/continuous/motion.h"

namespace carom::internal {

/// Resolves the impact at the time of the flier's event: the event's own contact and all contacts that are connected to it through bodies in
/// flight. Appends the states whose paths have changed.
void resolve_impact(const FlightSpan& span, Flier& first, std::vector<std::int32_t>& changed);

} // namespace carom::internal
