#pragma once

// The direct solve of hinges, beside the row after row of joint_solver.h.

#include "dynamics/contact_solver.h"
#include "dynamics/rows.h"

#include <span>

namespace carom::internal {

/// The points of all hinges of a unit at once; false where it has none, too many, loops or heavy loads: then the soft rows have to do.
[[nodiscard]] bool solve_hinges(const SolverView& view, SceneState& state, std::span<const JointWork> joints, bool use_bias);

} // namespace carom::internal
