#pragma once

// Impacts as they are reported.

#include "carom/event.h"
#include "dynamics/solver/contact/contact_solver.h"

namespace carom::internal {

/// The place of an arm's end on the constraint's first body.
[[nodiscard]] Position place_on_a(const StepContext& ctx, const SolverView& view, const ContactConstraint& constraint, Vec2 arm);

/// Fills in where a constraint was struck, its impulse, and the speeds before and after. Points that were struck count as one between them, because their
/// impulses act along one line. A corner that only bears a load has no part in it.
void fill_impact(const StepContext& ctx, const SolverView& view, const ContactConstraint& constraint, ImpactEvent& event);

} // namespace carom::internal
