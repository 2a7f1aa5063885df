#pragma once

// Memory of sleep, reused from step to step.

#include <cstdint>
#include <vector>

namespace carom::internal {

struct SleepWorkspace
{
    std::vector<std::uint8_t> is_tired;      ///< has been quiet for long enough, by awake index
    std::vector<std::uint8_t> is_kept_awake; ///< tired, but kept awake by a neighbor
};

} // namespace carom::internal
