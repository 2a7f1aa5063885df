#pragma once

// States, constraints and joints of the step's islands side by side: the second half of the islands stage.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Fills the arrays of Scratch that the solver runs over.
void lay_out_islands(StepContext& ctx);

/// The same for islands whose places are those of the last step.
void refill_islands(StepContext& ctx);

/// May all of its bodies move along every axis, or along none?
[[nodiscard]] bool is_uniform(const StepContext& ctx, const Island& island);
[[nodiscard]] bool has_even_mass(const StepContext& ctx, std::int32_t state);

/// Contacts that roll or convey, and what holds a body that may not move along every axis, have constraints of their own.
template <class AnyEdge>
[[nodiscard]] bool give_evenly(const StepContext& ctx, const AnyEdge& l)
{
    return has_even_mass(ctx, l.a) && has_even_mass(ctx, l.b);
}

/// Not a copy of a kinematic body, nor what stands for all that rests.
[[nodiscard]] inline bool is_dynamic(const Island& island, std::int32_t state)
{
    return static_cast<std::uint32_t>(state - island.first_state - 1) < static_cast<std::uint32_t>(island.dynamic_count);
}

} // namespace carom::internal
