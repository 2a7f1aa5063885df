#pragma once

// The safety sweep stops bodies at static shapes that their contacts did not cover.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Resets what is known around each block; called before the first free_displacement of a step.
void forget_surroundings(StepContext& ctx);

/// Displacement of a body that also rotates over the step, from its recorded pose, up to where static shapes stop it. For bodies that were
/// struck so hard in the step that they moved beyond what their constraints cover.
[[nodiscard]] Position free_displacement(const StepContext& ctx, int body, Position displacement, Rotation turn);

} // namespace carom::internal
