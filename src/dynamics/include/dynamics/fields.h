#pragma once

#include "dynamics/scene_data.h"

namespace carom::internal {

/// Adds the forces of fields to the bodies inside them.
void apply_fields(StepContext& ctx);

} // namespace carom::internal
