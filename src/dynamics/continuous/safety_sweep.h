#pragma once

#include "dynamics/step_context.h"

namespace carom::internal {

/// Before the first body of a step is asked for.
void forget_surroundings(StepContext& ctx);

/// How far a body that also turns comes on its way over the step (from its place in the records) before static shapes stop it. For bodies
/// that were struck so hard in the step that they went beyond what their constraints could see.
[[nodiscard]] Position free_displacement(const StepContext& ctx, int body, Position displacement, Rotation turn);

} // namespace carom::internal
