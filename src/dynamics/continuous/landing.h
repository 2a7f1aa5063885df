#pragma once

// The end of a sub-step in flight.

#include "dynamics/continuous/motion.h"

namespace carom::internal {

/// Moves the flier to the end of the sub-step and writes the body's state. A body that rests is solver-owned from the next sub-step on; its
/// constraints go to output.late_constraints.
void finish_flight(const FlightSpan& span, Flier& f);

} // namespace carom::internal
