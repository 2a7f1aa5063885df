#pragma once

// Where contact constraints stand: the last part of the islands stage.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Links stand island by island. By one thread: others have states to place.
void sort_edges(StepContext& ctx);

/// After both states and links have their places, those of small islands one after the other; large ones, on all threads, behind them.
void place_constraints_of_small_islands(StepContext& ctx);
void place_constraints_of_large_islands(StepContext& ctx);

} // namespace carom::internal
