#pragma once

// Who is solved together in this step, and what a body does in it: the first half of the islands stage.

#include "dynamics/solver/contact/coloring.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// When all links are known: fills Scratch::solver.islands with how many states and joints each has, solved_bodies and solved_joints in their order, island_of_edge, and who flies.
void build_island_graph(StepContext& ctx);

} // namespace carom::internal
