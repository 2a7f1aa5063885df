#pragma once

// Memory of triggers, reused from step to step.

#include "dynamics/continuous/path/body_path_piece.h"

#include <cstdint>
#include <vector>

namespace carom::internal {

/// A leaf entered or exited a leaf of a trigger.
struct Crossing
{
    std::int32_t contact = none;
    std::int32_t trigger = none; ///< the shapes that own the leaves
    std::int32_t visitor = none;
    std::int32_t order = 0; ///< order among all crossings of the step
    double time = 0;
    bool enters = false;
};

struct SensorWorkspace
{
    std::vector<PathPiece> paths; ///< paths of all islands, by body
    std::vector<Crossing> crossings;
};

} // namespace carom::internal
