#pragma once

// The user's force laws: bounds on what a law may do to a body in a step, and its call in every sub-step.

#include "dynamics/state/scene_data.h"
#include "dynamics/step_context.h"

#include <algorithm>

namespace carom::internal {

/// Null for a body without a law.
[[nodiscard]] inline const ForceLaw* force_law_of(const StepContext& ctx, int body)
{
    const auto slot = static_cast<std::size_t>(body);
    if (ctx.scene.law_count == 0 || slot >= ctx.scene.laws.size())
        return nullptr;
    return ctx.scene.laws[slot].function != nullptr ? &ctx.scene.laws[slot] : nullptr;
}

inline constexpr float most_of_law = 1e6f; ///< m, rad/s: a larger bound says no more, and boxes stay finite

/// Bounds on what its law may add to a body's displacement and to its spin within the step; 0 without a law.
[[nodiscard]] inline float greatest_shift_of_law(const StepContext& ctx, int body)
{
    const ForceLaw* law = force_law_of(ctx, body);
    if (law == nullptr)
        return 0;
    const Vec2 inverse_mass = ctx.state.sims[static_cast<std::size_t>(body)].inverse_mass;
    return std::min(ctx.dt * ctx.dt * law->greatest_force * std::max(inverse_mass.x, inverse_mass.y), most_of_law);
}
[[nodiscard]] inline float greatest_spin_of_law(const StepContext& ctx, int body)
{
    const ForceLaw* law = force_law_of(ctx, body);
    if (law == nullptr)
        return 0;
    return std::min(ctx.dt * law->greatest_torque * ctx.state.sims[static_cast<std::size_t>(body)].inverse_inertia, most_of_law);
}

/// Calls the laws of an island for the loads of sub-step k.
void apply_force_laws(const StepContext& ctx, const Island& island, int k, IslandOutput& output);

/// Keeps the impacts of this step that were not reported to a law: those of the last sub-step, and those that another island resolved.
void note_pending_impacts(StepContext& ctx);

} // namespace carom::internal
