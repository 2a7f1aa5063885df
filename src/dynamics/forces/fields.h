#pragma once

// Fields: forces of trigger shapes on the bodies inside them.

#include "dynamics/state/scene_data.h"

namespace carom::internal {

[[nodiscard]] inline bool acts(const Field& field)
{
    return field.force != Vec2{} || field.acceleration != Vec2{} || field.drag != 0;
}

/// Adds the forces of fields to the bodies inside them, and applies drag.
void apply_fields(StepContext& ctx);

} // namespace carom::internal
