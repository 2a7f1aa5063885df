#pragma once

// The solver's passes over joints, alongside those over contact constraints.

#include "dynamics/solver/joint/direct/direct_solver.h"
#include "dynamics/state/turns.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Anchors relative to the centers of mass at the start of the step, and anchor b - anchor a; world axes.
struct JointArms
{
    Vec2 a{};
    Vec2 b{};
    Vec2 gap{};
};
[[nodiscard]] JointArms joint_arms(const SceneState& state, const JointRecord& joint);

[[nodiscard]] JointWork prepare_joint(const StepContext& ctx, const Island& island, const SolvedJoint& place);

void warm_start_joints(const SolverView& view, SceneState& state, std::span<JointWork> joints, DirectSolve& direct);
/// Solves the joints all at once where the direct solve is ready, else row by row.
void solve_joints(const SolverView& view, SceneState& state, std::span<JointWork> joints, DirectSolve& direct, float joint_hertz,
                  bool use_bias);

/// Speeds toward the limits are recorded before the forces of a sub-step; bodies bounce off the limits after it.
void note_limit_approach(const SolverView& view, const SceneState& state, std::span<JointWork> joints);
void bounce_off_limits(const SolverView& view, SceneState& state, std::span<JointWork> joints, DirectSolve& direct,
                       float rest_speed);

/// Marks bodies that are at a stop whose other body cannot rotate: an impact finds them immovable in that direction of rotation, whatever other joints they have.
void note_stops(const SolverView& view, std::span<const JointWork> joints);

/// Sums the impulses for the read-back, and notes stops.
void finish_joint_substep(const SolverView& view, SceneState& state, std::span<JointWork> joints);

} // namespace carom::internal
