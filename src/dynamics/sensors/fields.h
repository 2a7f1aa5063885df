#pragma once

#include "dynamics/state/scene_data.h"

namespace carom::internal {

[[nodiscard]] inline bool acts(const Field& field)
{
    return field.force != Vec2{} || field.acceleration != Vec2{} || field.drag != 0;
}

/// Adds the forces of fields to the bodies inside them.
void apply_fields(StepContext& ctx);

} // namespace carom::internal
