#pragma once

// Records the paths of bodies within a step as they happen, for bodies near triggers and for those that flight has deflected:
// triggers.cpp finds in them when a body enters and leaves.

#include "dynamics/continuous/motion.h"

namespace carom::internal {

/// Records the path of a state from a time of the sub-step on, if it is to be recorded.
void trace(const FlightSpan& span, std::int32_t state, double time);

/// Records the paths of all such states of the island from the start of the sub-step on, when the solver has moved its bodies.
void trace_all(const FlightSpan& span);

} // namespace carom::internal
