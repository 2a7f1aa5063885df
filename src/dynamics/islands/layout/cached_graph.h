#pragma once

// Islands that are what they were.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Bodies awake, and in the parts of the plane by which they are laid out.
[[nodiscard]] bool bodies_are_unchanged(const StepContext& ctx);

/// When all links are known: would islands, colours and places come out as they did in the last step? They are still in Scratch.
[[nodiscard]] bool graph_is_unchanged(const StepContext& ctx);

/// After islands have been built and laid out: notes what they were made of.
void cache_graph(StepContext& ctx);

} // namespace carom::internal
