#pragma once

// Rows and joints of one unit: from contacts and joint records to what the solver runs over, and back. It is done around the unit's solve, so that a
// small unit stays in the cache from its first row to its last impulse.

#include "core/crew.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// At the places that island_layout.h gave out; a large one by all of the crew.
void fill_unit(const StepContext& ctx, const Unit& unit, Crew& crew);

/// Impulses and forces, to contacts and joints.
void commit_unit(const StepContext& ctx, const Unit& unit, Crew& crew);

/// Of a row that the unit got while it was solved.
void commit_row(SceneState& state, const ContactRow& row);

} // namespace carom::internal
