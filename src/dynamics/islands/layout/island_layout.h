#pragma once

// States, constraints and joints of all islands side by side: the second half of the islands stage.

#include "dynamics/step_context.h"

namespace carom::internal {

/// Fills the arrays of Scratch that the solver runs over.
void lay_out_islands(StepContext& ctx);

/// The same for islands whose slots are those of the last step.
void refill_islands(StepContext& ctx);

/// May each of its bodies move along both axes, or along none?
[[nodiscard]] bool is_uniform(const StepContext& ctx, const Island& island);
[[nodiscard]] bool has_even_mass(const StepContext& ctx, std::int32_t state);

/// Does each body have the same inverse mass along both axes? Otherwise the constraint is solved outside of lanes.
template <class AnyEdge>
[[nodiscard]] bool give_evenly(const StepContext& ctx, const AnyEdge& l)
{
    return has_even_mass(ctx, l.a) && has_even_mass(ctx, l.b);
}

/// False for the copy of a kinematic body and for the state that stands for all bodies at rest.
[[nodiscard]] inline bool is_dynamic(const Island& island, std::int32_t state)
{
    return static_cast<std::uint32_t>(state - island.first_state - 1) < static_cast<std::uint32_t>(island.dynamic_count);
}

} // namespace carom::internal
