#pragma once

/// @file
/// The cost of truth in company: crowds in flight, landings, many small islands and long joint graphs.

#include "speed/run.h"

#include <functional>
#include <string>
#include <vector>

namespace speed {

struct CompanyCost
{
    std::string what{};
    std::vector<double> ms{}; ///< medians of a step's time, by contender
};

/// All contenders step the same scene in turn. Each scene is told as soon as it is known.
void company_costs(const RunOptions& options, const std::vector<std::string>& engines,
                   const std::function<void(const CompanyCost&)>& tell);

} // namespace speed
