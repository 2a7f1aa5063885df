#pragma once

// From records to what the solver iterates over.

#include "dynamics/step_context.h"

namespace carom::internal {

[[nodiscard]] BodyState initial_state(const SceneState& state, int body);
[[nodiscard]] StateConstants state_constants(const StepContext& ctx, int body);
[[nodiscard]] ContactRow prepare_row(const StepContext& ctx, int contact, const Manifold& manifold, std::int32_t a,
                                     std::int32_t b);
/// A body in flight; joint: the hinge to the world that it turns on, or none.
[[nodiscard]] Flier make_flier(const StepContext& ctx, std::int32_t state, int body, int joint);

/// Writes the points of a manifold taken at the bodies' present poses within the step into the row.
void set_row_geometry(const Scratch& scratch, ContactRow& row, const Manifold& manifold);

/// In small units rows are looked at anew within the step.
inline void follow_closely(const Contact& contact, const Unit& unit, ContactRow& row)
{
    const bool round = (contact.flags & contact_flag::round) != 0;
    row.refreshed = unit.precise && round;
    row.followed = unit.precise && !round;
}

/// All impulses of the last sub-step, for a sub-step of another length.
void scale_row(ContactRow& row, float by);

} // namespace carom::internal
