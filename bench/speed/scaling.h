#pragma once

/// @file
/// How cost grows with what is in the world, on Carom alone.

#include "speed/run.h"

#include <cstdint>
#include <vector>

namespace speed {

/// A pile of boxes and discs, twenty high, that has settled and is stirred by slow bars: everything is awake and touches something.
struct PileCost
{
    int bodies = 0;
    int pairs = 0; ///< that the engine keeps
    int steps = 0; ///< that were timed
    double ms_per_step = 0;
    double ns_per_body = 0; ///< and step
    Stages stages{};        ///< of these
    double bytes_per_body = 0;
};

/// `progress` may throw Interrupted.
[[nodiscard]] PileCost pile_cost(int bodies, const RunOptions& options);

/// So many boxes that never move, and one ball above them.
struct StaticCost
{
    int shapes = 0;
    double build_s = 0;
    double us_per_step = 0;
    double us_per_move = 0; ///< of one of the boxes, the step after it included
};
[[nodiscard]] StaticCost static_cost(int shapes, const RunOptions& options);

/// Separate scenes of a few boxes, stepped by so many threads of the caller's that share nothing.
struct SmallScenesCost
{
    int scenes = 0;
    int threads = 0;
    double us_per_step = 0; ///< wall time, of one scene
    std::uint64_t hash = 0; ///< of all states: the same however many threads
};
[[nodiscard]] SmallScenesCost small_scenes_cost(int scenes, int threads, const RunOptions& options);

} // namespace speed
