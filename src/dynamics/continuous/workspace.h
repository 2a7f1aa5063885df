#pragma once

// Bodies in flight, and what the safety sweep knows.

#include "dynamics/continuous/flier.h"

#include <cstdint>
#include <vector>

namespace carom::internal {

/// What rests around eight neighbours and their ways, see safety_sweep.cpp.
enum class Surroundings : std::uint8_t
{
    Unknown,
    Clear,
    Taken
};

struct FlightWorkspace
{
    std::vector<Flier> fliers;
    std::vector<double> event_times; ///< of each flier, side by side: the search for the earliest looks at nothing else
    std::vector<std::int32_t> flier_of_state;
    std::vector<std::int32_t> versions;     ///< of states: counts changes of their paths within a sub-step
    std::vector<Surroundings> surroundings; ///< of each block of the moving layer
};

} // namespace carom::internal
