#pragma once

// Moves single contacts into wide contact constraints, and back.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Clears what a constraint sums up over a step.
/// Fills the features of one lane from its contact; for an empty lane they are 0.
void fill_features(const SceneState& state, std::int32_t contact, WideFeatures& features, int i);
void clear_sums(WideContact& constraint, WideContactNotes& notes);

/// Writes the contact of an edge between states into a lane that it has occupied before, as
/// WideKernels::fill does for eight lanes; sums are cleared already. WideKernels::prepare does the rest.
void refill_lane(const StepContext& ctx, const ContactEdge& states, WideContact& constraint, WideContactNotes& notes, int lane);

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
