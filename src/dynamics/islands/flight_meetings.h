#pragma once

#include "dynamics/step_context.h"

namespace carom::internal {

/// Joins islands in Scratch::graph.sets whose bodies may meet in flight; fills Scratch::meetings.is_deflected and may_be_struck. True where islands have become one.
[[nodiscard]] bool join_deflected(StepContext& ctx);

} // namespace carom::internal
