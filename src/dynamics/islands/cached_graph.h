#pragma once

// Units that are what they were.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Bodies awake, and in the parts of the plane by which they are laid out.
[[nodiscard]] bool bodies_stay(const StepContext& ctx);

/// When all links are known: would units, colours and places come out as they did in the last step? They are still in Scratch.
[[nodiscard]] bool units_stay(const StepContext& ctx);

/// After units have been built and laid out: notes what they were made of.
void keep_units(StepContext& ctx);

} // namespace carom::internal
