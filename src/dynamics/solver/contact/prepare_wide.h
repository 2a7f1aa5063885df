#pragma once

// Moves single contacts into wide contact constraints, and back.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Fills the features of one lane from its contact; for an empty lane they are 0.
void fill_features(const SceneState& state, std::int32_t contact, WideFeatures& features, int lane);

/// Clears what a constraint sums up over a step.
void clear_sums(WideContact& constraint, WideContactNotes& notes);

/// Writes a contact again into its lane of the wide constraint at an index in SolverWorkspace::wide_contacts, as WideKernels::fill does for eight lanes; sums
/// are cleared already. WideKernels::prepare does the rest.
void refill_lane(const StepContext& ctx, std::size_t at, int lane);

/// The lanes that hold a contact, as bits.
[[nodiscard]] std::uint32_t filled_lanes(const WideContactNotes& notes);

/// The lane as a constraint of its own: arms at the start of the step, impulses, and effective masses along the normal.
[[nodiscard]] ContactConstraint constraint_of_lane(Scratch& scratch, std::int32_t lane);

/// Writes the impulses of such a constraint back into its lane.
void put_impulses(Scratch& scratch, const ContactConstraint& constraint, std::int32_t lane);

/// For a contact whose body has taken off: the lane applies no more impulses.
void drop_lane(const StepContext& ctx, Contact& contact, std::int32_t fixed);

/// True for a hinge without restitution at its limits; its bodies must also be able to move along every axis.
[[nodiscard]] bool fits_joint_lane(const JointRecord& joint);

} // namespace carom::internal
