#pragma once

/// @file
/// The cost of impacts at their own time, where there are few of them or far too many.

#include "speed/run.h"

#include <functional>
#include <string>

namespace speed {

/// The same world twice, stepped in turn: medians over the steps.
struct FlightCost
{
    std::string what{};
    double without_ms = 0;
    double with_ms = 0;
    int fliers = 0;  ///< bodies in flight in the last step
    int impacts = 0; ///< of the last step, at their own time
    int others = 0;  ///< left to the solver

    [[nodiscard]] double extra_percent() const { return 100 * (with_ms / without_ms - 1); }
};

/// Each is told as soon as it is known:
/// - a pile of 5,000 at rest, continuous collision off and on;
/// - the same, on, without and with one ball that flies to and fro above it at 100 m/s;
/// - 2,000 boxes and discs of restitution 0.5 that tumble in a turning drum, off and on.
void flight_costs(const RunOptions& options, const std::function<void(const FlightCost&)>& tell);

} // namespace speed
