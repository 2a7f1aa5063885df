#pragma once

// Resting contacts within a sub-step of flight.

#include "dynamics/continuous/motion.h"

namespace carom::internal {

/// Changes the velocity of a body that the solver has already moved to the end of the sub-step, `left` seconds before that end.
void correct_state(const FlightSpan& span, std::int32_t state, double left, double dvx, double dvy, double dw);

/// Ends the flier's resting contacts at a time: solver-owned bodies that it pressed get their impulses. The accelerations are free again.
void release_resting_contacts(const FlightSpan& span, Flier& f, double time);

} // namespace carom::internal
