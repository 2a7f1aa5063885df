#pragma once

// Islands that are unchanged since the last step.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Compares the awake bodies and their plane cells, by which they are laid out.
[[nodiscard]] bool bodies_are_unchanged(const StepContext& ctx);

/// Called when all edges are known: would islands, colors and slots be those of the last step? They are still in Scratch.
[[nodiscard]] bool graph_is_unchanged(const StepContext& ctx);

/// Called after islands have been built and laid out: stores the inputs for comparison.
void cache_graph(StepContext& ctx);

} // namespace carom::internal
