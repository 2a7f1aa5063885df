#pragma once

// The safety sweep stops bodies at static shapes that their contacts did not cover.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Resets what is known around each block; called before the first free_displacement of a step.
void forget_surroundings(StepContext& ctx);

/// Displacement of a body over the step, at whose end it has that rotation, from its previous pose up to where static shapes stop it. For bodies that were
/// struck so hard in the step that they moved beyond what their constraints cover.
[[nodiscard]] Position free_displacement(const StepContext& ctx, int body, Position displacement, Rotation rotation);

} // namespace carom::internal
