#pragma once

// From contacts to wide contact constraints, and back.

#include "dynamics/step_context.h"

namespace carom::internal {

/// What a constraint gathers over a step.
void clear_sums(WideContact& constraint, WideContactNotes& notes);

/// Writes the contact of a link between states into a lane that it has stood in before, as WideKernels::fill does with eight; sums are cleared already.
/// WideKernels::prepare does the rest.
void refill_lane(const StepContext& ctx, const ContactEdge& states, WideContact& constraint, WideContactNotes& notes, int lane);

/// As bits.
[[nodiscard]] std::uint32_t filled_lanes(const WideContactNotes& notes);

/// The lane as a constraint of its own: where its points are at the start of the step, what they bear, and the masses along the normal.
[[nodiscard]] ContactConstraint constraint_of_lane(Scratch& scratch, std::int32_t lane);

/// Impulses of such a constraint go back into its lane.
void put_impulses(Scratch& scratch, const ContactConstraint& constraint, std::int32_t lane);

/// Its body has taken off: the lane pushes no more.
void drop_lane(const StepContext& ctx, Contact& contact, std::int32_t fixed);

/// A hinge that bounces off no limit; its bodies must be able to move along every axis.
[[nodiscard]] bool fits_joint_lane(const JointRecord& joint);

} // namespace carom::internal
