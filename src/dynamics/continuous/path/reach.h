#pragma once

// A circle around the path of a body in a sub-step tells early which other bodies it cannot meet.

#include "dynamics/continuous/motion.h"

namespace carom::internal {

/// Notes the reach of a flier after its path has changed.
void find_reach(const FlightSpan& span, std::int32_t flier);
/// Reach of a flier, or of one that has been deflected and has landed.
[[nodiscard]] Reach reach_in_list(const FlightSpan& span, std::int32_t flier);
/// Reach of a dynamic body of the island, in flight or not, for the rest of the sub-step.
[[nodiscard]] Reach reach_of(const FlightSpan& span, int body);
/// Time before which the two cannot meet; 1e300: they do not.
[[nodiscard]] double first_meeting(const Reach& a, const Reach& b);

} // namespace carom::internal
