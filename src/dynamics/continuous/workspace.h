#pragma once

// Scratch memory of flight and of the safety sweep.

#include "dynamics/continuous/deflected.h"
#include "dynamics/continuous/flier.h"

#include <cstdint>
#include <vector>

namespace carom::internal {

/// Whether anything rests around a block of eight neighbors and their displacements, see safety_sweep.cpp.
enum class Surroundings : std::uint8_t
{
    Unknown,
    Clear,
    Taken
};

struct FlightWorkspace
{
    std::vector<Flier> fliers;
    std::vector<double> event_times;           ///< by flier
    std::vector<std::int32_t> first_of_events; ///< of each island's Tournament: two for each flier
    std::vector<Reach> reaches;                ///< by flier; of the landed ones only if they have been deflected
    std::vector<std::int32_t> flier_of_state;
    std::vector<std::int32_t> versions;     ///< by state: counts changes of its path within a sub-step
    std::vector<Surroundings> surroundings; ///< by block of the moving layer
};

} // namespace carom::internal
