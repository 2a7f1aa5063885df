#pragma once

// Search for the next event of a body in flight: an impact, a hinge limit, or a resting contact to renew.

#include "core/tournament.h"
#include "dynamics/continuous/motion.h"
#include "dynamics/continuous/path/reach.h"

namespace carom::internal {

void find_next_event(const FlightSpan& span, Flier& f);

/// The same, but writes to the flier alone, before the tournament starts. False if it passes through a one-way shape, which must be noted before the search goes on.
[[nodiscard]] bool try_find_next_event(const FlightSpan& span, Flier& f);

/// The same if only the path of state `struck` has changed, and `contact` is the flier's contact with it.
void reconsider(const FlightSpan& span, Flier& f, std::int32_t struck, int contact);

/// The event times of the island's fliers.
[[nodiscard]] Tournament events_of(const FlightSpan& span);

/// How often the path of a state has changed in this sub-step.
[[nodiscard]] inline std::int32_t version_of(const FlightSpan& span, std::int32_t state)
{
    return state == none ? 0 : span.scratch.flight.versions[static_cast<std::size_t>(state)];
}

} // namespace carom::internal
