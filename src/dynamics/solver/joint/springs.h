#pragma once

// Springs by kicks: one before the bodies move and one after. They are exact for a spring that alone joins its bodies. Other springs, where joints are
// solved at once, and those along a free axis of another joint are rows (joint_axis.h), and kick only after the move.

#include "dynamics/solver/joint/joint_bodies.h"

#include <span>

namespace carom::internal {

/// Whether the kicks follow the spring exactly: it is the only joint of its bodies, not too stiff for the sub-step, and its line turns slowly.
[[nodiscard]] bool has_exact_kicks(const SolverView& view, const SceneState& state, const JointWork& work);

/// Computes the coefficients of both kicks, once per step: the effective mass changes little within it.
void fit_spring(const SolverView& view, const SceneState& state, JointWork& work);

/// The same for the springs along the free axes of another joint, or for its soft limits. Where all bodies drift along parabolas, a spring acts before the
/// bodies move and after. Elsewhere, and where the spring may engage or disengage within the sub-step, all of it acts before. `rows` are those at the start
/// of the step.
void fit_axis_springs(const SolverView& view, const JointRecord& joint, const JointRows& rows, bool direct, bool drifts,
                      JointWork& work);

void kick_springs_before(const SolverView& view, SceneState& state, std::span<JointWork> joints);
void kick_springs_after(const SolverView& view, SceneState& state, std::span<JointWork> joints);

} // namespace carom::internal
