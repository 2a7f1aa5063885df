#pragma once

// Slots of contact constraints: the last part of the islands stage.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Sorts contact edges by island. Runs on one thread, because the others place states meanwhile.
void sort_edges(StepContext& ctx);

/// Called after states and edges have their slots. Constraints of small islands are placed one island after the other; those of large islands follow, each on
/// all threads.
void place_constraints_of_small_islands(StepContext& ctx);
void place_constraints_of_large_islands(StepContext& ctx);

} // namespace carom::internal
