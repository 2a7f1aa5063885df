// Force laws are called before everything else in a sub-step. Their loads become an acceleration that is
// constant over the sub-step, beside gravity and applied force: constraints and flight know nothing of laws.

#include "dynamics/forces/force_laws.h"

#include "dynamics/continuous/flight.h"
#include "dynamics/state/contact_store.h"

#include "core/refuse.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

bool takes_part(BodyId body, const ImpactEvent& event) { return event.body_a == body || event.body_b == body; }

// Impacts of the body since its law was last called.
std::span<const ImpactEvent> impacts_of(const StepContext& ctx, int body, int k, IslandOutput& output)
{
    output.law_impacts.clear();
    if (k == 0)
    {
        for (const PendingImpact& unreported : ctx.scene.pending_impacts)
            if (unreported.body == body)
                output.law_impacts.push_back(unreported.event);
    }
    const BodyId id = body_id(ctx.state, body);
    for (const ImpactEvent& event : std::span(output.impacts).subspan(output.reported_impacts))
        if (takes_part(id, event))
            output.law_impacts.push_back(event);
    return output.law_impacts;
}

BodyMotion motion_at(const StepContext& ctx, const BodySim& sim, const BodyState& s, int k, std::span<const ImpactEvent> impacts)
{
    const Rotation rotation = s.delta_rotation * sim.rotation;
    return {.time = static_cast<double>(ctx.dt) * k / ctx.substeps,
            .h = ctx.h,
            .pose = {sim.center + s.delta_position - rotate(rotation, sim.local_center), rotation},
            .velocity = s.velocity,
            .angular_velocity = s.angular_velocity,
            .impacts = impacts};
}

// True for finite accelerations that lead to no overflow in this step: the bound of the sweep.
bool is_sound(const StepContext& ctx, Vec2 acceleration, float angular_acceleration)
{
    return ctx.dt * (std::fabs(acceleration.x) + std::fabs(acceleration.y) + std::fabs(angular_acceleration)) < 1e15f;
}

// A law that clamps its load to the promised bound may exceed it by rounding; greatest_shift_of_law() has room for far more.
bool exceeds(const ForceLaw& law, const Load& load)
{
    constexpr float rounding = 1.0001f;
    return length(load.force) > rounding * law.greatest_force || std::fabs(load.torque) > rounding * law.greatest_torque;
}

void apply_force_law(const StepContext& ctx, const LawWork& work, int k, IslandOutput& output)
{
    Scratch& scratch = ctx.scratch;
    const auto index = static_cast<std::size_t>(work.state);
    BodyState& s = scratch.solver.states[index];
    if ((s.flags & body_flag::unsound) != 0)
        return;
    const int body = scratch.solver.state_bodies[index];
    const ForceLaw& law = ctx.scene.laws[static_cast<std::size_t>(body)];
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    const Load load = law.function(law.user, motion_at(ctx, sim, s, k, impacts_of(ctx, body, k, output)));
    StateConstants& c = scratch.solver.constants[index];
    c.acceleration = work.acceleration + Vec2{c.inverse_mass.x * load.force.x, c.inverse_mass.y * load.force.y};
    c.angular_acceleration = work.angular_acceleration + c.inverse_inertia * load.torque;
    if (!is_sound(ctx, c.acceleration, c.angular_acceleration))
    {
        c.acceleration = work.acceleration;
        c.angular_acceleration = work.angular_acceleration;
        s.flags |= body_flag::unsound;
    }
    else if (const std::int32_t f = scratch.flight.flier_of_state[index]; f != none && exceeds(law, load))
    {
        note_deflected(scratch, output, f); // it may leave the boxes that its pairs were found with
    }
}

} // namespace

void apply_force_laws(const StepContext& ctx, const Island& island, int k, IslandOutput& output)
{
    if (island.law_count == 0)
        return;
    for (std::int32_t i = island.first_law; i < island.first_law + island.law_count; ++i)
        apply_force_law(ctx, ctx.scratch.solver.laws[static_cast<std::size_t>(i)], k, output);
    output.reported_impacts = output.impacts.size();
}

void note_pending_impacts(StepContext& ctx)
{
    ctx.scene.pending_impacts.clear();
    if (ctx.scene.law_count == 0)
        return;
    const SceneState& state = ctx.state;
    const auto note = [&](std::size_t island, std::size_t i, BodyId id, const ImpactEvent& event)
    {
        const int body = slot_of(id);
        const int place = state.bodies[body].awake_index;
        const bool of_island =
            place != none && ctx.scratch.graph.island_of[static_cast<std::size_t>(place)] == static_cast<int>(island);
        if (force_law_of(ctx, body) != nullptr && !(of_island && i < ctx.scratch.solver.outputs[island].reported_impacts))
            ctx.scene.pending_impacts.push_back({body, event});
    };
    for (std::size_t u = 0; u < ctx.scratch.solver.islands.size(); ++u)
    {
        const std::vector<ImpactEvent>& impacts = ctx.scratch.solver.outputs[u].impacts;
        for (std::size_t i = 0; i < impacts.size(); ++i)
        {
            note(u, i, impacts[i].body_a, impacts[i]);
            note(u, i, impacts[i].body_b, impacts[i]);
        }
    }
}

} // namespace carom::internal
