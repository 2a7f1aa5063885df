#pragma once

// The passes over joints, beside those over contact rows.

#include "dynamics/contact_solver.h"
#include "dynamics/joint_rows.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// The rows that a joint keeps whatever happens: neither limits nor motors nor springs.
[[nodiscard]] JointRows holding_rows(const JointRecord& joint, const JointPose& pose);

/// Angle of body b against body a, less the reference angle; (-pi, pi].
[[nodiscard]] float hinge_angle(const SceneState& state, const JointRecord& joint);

[[nodiscard]] JointWork prepare_joint(const StepContext& ctx, int joint, std::int32_t a, std::int32_t b);

/// Springs act once per sub-step, before everything else.
void apply_springs(const SolverView& view, SceneState& state, std::span<JointWork> joints);
void warm_start_joints(const SolverView& view, SceneState& state, std::span<JointWork> joints);
void solve_joints(const SolverView& view, SceneState& state, std::span<JointWork> joints, float joint_hertz, bool use_bias);

/// Speeds towards the limits, before a sub-step's forces; and the bounce off them after it.
void note_limit_approach(const SolverView& view, const SceneState& state, std::span<JointWork> joints);
void bounce_off_limits(const SolverView& view, SceneState& state, std::span<JointWork> joints, float rest_speed);

/// Sums impulses for the read-back; marks bodies that lean on a limit of a hinge to the world.
void finish_joint_substep(const SolverView& view, SceneState& state, std::span<JointWork> joints);

} // namespace carom::internal
