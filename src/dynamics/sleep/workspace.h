#pragma once

// Memory of sleep, kept from step to step.

#include <cstdint>
#include <vector>

namespace carom::internal {

struct SleepWorkspace
{
    std::vector<std::uint8_t> is_tired;      ///< has been quiet for long enough, by place in awake_bodies
    std::vector<std::uint8_t> is_kept_awake; ///< of these, by a neighbour
};

} // namespace carom::internal
