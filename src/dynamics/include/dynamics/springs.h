#pragma once

// Springs between two points: a kick before the bodies move and one after.

#include "dynamics/joint_bodies.h"

#include <span>

namespace carom::internal {

/// The coefficients of both kicks, once a step: the effective mass changes little within it.
void fit_spring(const SolverView& view, const SceneState& state, JointWork& work);

void kick_springs_before(const SolverView& view, SceneState& state, std::span<JointWork> joints);
void kick_springs_after(const SolverView& view, SceneState& state, std::span<JointWork> joints);

} // namespace carom::internal
