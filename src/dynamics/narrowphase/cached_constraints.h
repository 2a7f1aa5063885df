#pragma once

// Wide contact constraints that are unchanged since the last step.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Replaces the update of contacts one by one. Where the graph is unchanged and every contact still fits its lane, normals, arms and separations are refreshed
/// in place, eight at a time. False where something has changed: then all contacts are updated as usual, except for those in Scratch::narrow.is_looked_at,
/// which are up to date.
[[nodiscard]] bool refresh_cached_constraints(StepContext& ctx);

/// Called once the constraints of unchanged islands are to be filled in this step: may they be refreshed in the next one?
void cache_constraints(StepContext& ctx);

} // namespace carom::internal
