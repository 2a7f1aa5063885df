#pragma once

// What bodies do within a step is written down as it happens, of those near triggers and of those that flight has thrown off their way:
// triggers.cpp finds there when they came and went.

#include "dynamics/continuous/motion.h"

namespace carom::internal {

/// The path of a state, if it is to be recorded, from a time of the sub-step on.
void trace(const FlightSpan& span, std::int32_t state, double time);

/// The paths of all such states of the island from the start of the sub-step on, when the solver has moved its bodies.
void trace_all(const FlightSpan& span);

} // namespace carom::internal
