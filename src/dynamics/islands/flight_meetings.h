#pragma once

// Islands whose bodies may meet in flight.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Joins islands in Scratch::graph.sets whose bodies may meet in flight. Fills Scratch::meetings.is_deflected and Scratch::graph.may_be_struck. True where
/// islands have been merged.
[[nodiscard]] bool join_deflected(StepContext& ctx);

} // namespace carom::internal
