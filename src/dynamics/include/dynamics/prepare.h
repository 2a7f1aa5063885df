#pragma once

// From records to what the solver iterates over.

#include "dynamics/step_context.h"

namespace carom::internal {

[[nodiscard]] BodyState initial_state(const SceneState& state, int body);
[[nodiscard]] StateConstants state_constants(const StepContext& ctx, int body);
[[nodiscard]] ContactRow prepare_row(const StepContext& ctx, int contact, const Manifold& manifold, std::int32_t a,
                                     std::int32_t b);
[[nodiscard]] Flier make_flier(const StepContext& ctx, std::int32_t state, int body, int shape);

/// Writes the points of a manifold taken at the bodies' present poses within the step into the row.
void set_row_geometry(const Scratch& scratch, ContactRow& row, const Manifold& manifold);

} // namespace carom::internal
