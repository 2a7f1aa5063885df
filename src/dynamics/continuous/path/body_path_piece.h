#pragma once

// A piece of a path, as islands record it.

#include "collision/time_of_impact.h"
#include "dynamics/state/scene_state.h"

#include <cstdint>

namespace carom::internal {

/// A body's path from a time of the step until its next piece.
struct PathPiece
{
    std::int32_t body = none;
    std::int32_t order = 0; ///< index among all pieces of the step
    double start = 0;
    FramePath path{}; ///< relative to the center of mass at the start of the step
};

} // namespace carom::internal
