#pragma once

// The island graph: which bodies are solved together and what each does in this step. This is the first half of the islands stage.

#include "dynamics/state/coloring.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Called when all edges are known. Fills Scratch::solver.islands with the number of states and joints of each island, solved_bodies and solved_joints in
/// island order, and island_of_edge. Determines which bodies fly.
void build_island_graph(StepContext& ctx);

} // namespace carom::internal
