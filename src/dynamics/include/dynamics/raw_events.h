#pragma once

// Events as the user gets them, from what the units noted.

#include "dynamics/contact_store.h"
#include "dynamics/scene_data.h"

namespace carom::internal {

[[nodiscard]] inline ImpactEvent impact_event(const SceneState& state, const RawImpact& raw)
{
    ImpactEvent event = raw.event;
    event.shape_a = shape_id(state, raw.shape_a);
    event.shape_b = shape_id(state, raw.shape_b);
    event.body_a = body_id(state, state.shapes[raw.shape_a].body);
    event.body_b = body_id(state, state.shapes[raw.shape_b].body);
    return event;
}

} // namespace carom::internal
