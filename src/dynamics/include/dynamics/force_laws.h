#pragma once

// The user's force laws: what a body may be given in a step, and the call in every sub-step.

#include "dynamics/scene_data.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Nothing for a body without one.
[[nodiscard]] inline const ForceLaw* force_law_of(const StepContext& ctx, int body)
{
    if (ctx.scene.law_count == 0)
        return nullptr;
    const ForceLaw& law = ctx.scene.body_extras[static_cast<std::size_t>(body)].law;
    return law.function != nullptr ? &law : nullptr;
}

/// What its law may add to a body's way and to its spin within the step; 0 without a law.
[[nodiscard]] float greatest_shift_of_law(const StepContext& ctx, int body);
[[nodiscard]] float greatest_spin_of_law(const StepContext& ctx, int body);

/// Asks the laws of a unit for the loads of the sub-step k.
void apply_force_laws(const StepContext& ctx, const Unit& unit, int k, UnitOutput& output);

/// Keeps the impacts of this step that no law was told: those of the last sub-step, and those that another unit resolved.
void note_untold_impacts(StepContext& ctx);

} // namespace carom::internal
