#pragma once

// Wide constraints that are what they were.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Instead of updating contacts one by one: where islands have stayed, and every contact has still what its lane was made for, normals, arms and separations
/// are followed where they stand, eight at a time. False where something has changed: then all is to be done as ever, but that some contacts are up to date
/// (Scratch::narrow.is_looked_at).
[[nodiscard]] bool refresh_cached_constraints(StepContext& ctx);

/// Once the constraints of islands that stay are known to be filled in this step: may they be followed in the next?
void cache_constraints(StepContext& ctx);

} // namespace carom::internal
