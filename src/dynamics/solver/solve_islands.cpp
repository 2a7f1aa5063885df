// Stage 5, solve. All threads solve large islands together, one after the other. Small islands are solved side
// by side, a batch of them to a task; threads that a large island leaves idle take such batches, too. An
// island's constraints are filled just before it is solved (island_solver.cpp) and committed right after.

#include "core/grow.h"
#include "core/task_pool.h"
#include "core/trigonometry.h"
#include "dynamics/continuous/flight.h"
#include "dynamics/solver/body_state.h"
#include "dynamics/solver/contact/partitions.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/solver/island_constraints.h"
#include "dynamics/solver/island_solver.h"
#include "dynamics/stages.h"
#include "dynamics/state/turns.h"

#include <algorithm>
#include <utility>

namespace carom::internal {

namespace {

// A parabola and an even rotation: in double, rounded once. Damping acts after each sub-step, as for all other bodies.
void advance_free_fall(const StepContext& ctx, std::int32_t index)
{
    BodyState& s = ctx.scratch.solver.states[static_cast<std::size_t>(index)];
    const StateConstants& c = ctx.scratch.solver.constants[static_cast<std::size_t>(index)];
    const double h = static_cast<double>(ctx.h);
    const auto sum = [&](float& speed, float acceleration, float decay)
    {
        double displacement = 0;
        auto v = static_cast<double>(speed);
        for (int k = 0; k < ctx.substeps; ++k)
        {
            const double after = static_cast<double>(decay) * (v + h * static_cast<double>(acceleration));
            displacement +=
                h * (after - 0.5 * h * static_cast<double>(acceleration)); // the mean of the velocities before and after
            v = after;
        }
        speed = static_cast<float>(v);
        return static_cast<float>(displacement);
    };
    s.delta_position.x = sum(s.velocity.x, c.acceleration.x, c.linear_decay);
    s.delta_position.y = sum(s.velocity.y, c.acceleration.y, c.linear_decay);
    turn_from_start(s, static_cast<double>(sum(s.angular_velocity, c.angular_acceleration, c.angular_decay)));
}

void advance_free_fall(const StepContext& ctx, const Island& island)
{
    for (std::int32_t s = island.first_state + 1; s <= island.first_state + island.dynamic_count; ++s)
        advance_free_fall(ctx, s);
}

void solve(const StepContext& ctx, std::size_t u, IslandEnergy& energy, WorkerTeam& team)
{
    const Island& island = ctx.scratch.solver.islands[u];
    if (fly_whole_step(ctx, island, ctx.scratch.solver.outputs[u], team))
        return;
    fill_island(ctx, island, team);
    solve_island(ctx, island, ctx.scratch.solver.outputs[u], energy, team);
    commit_island(ctx, island, team);
}

// Approximate number of bodies in a batch: enough work for a task, and a choice that depends on the islands alone.
constexpr int batch_bodies = 64;

// The islands of a batch are solved one after the other in the same memory, which stays in the cache, unless
// their constraints are cached for the next step. Fills Scratch::order with the starts of the batches.
void form_batches(Scratch& scratch)
{
    std::vector<std::int32_t>& starts = scratch.order;
    starts.assign(1, 0);
    std::int32_t store = 0;
    std::int32_t large = 0;
    std::int32_t most = 0; // blocks of the largest island in the batch
    int bodies = 0;
    for (std::size_t i = 0; i < scratch.solver.islands.size(); ++i)
    {
        Island& island = scratch.solver.islands[i];
        island.wide_store = store;
        if (is_shared(island))
        {
            island.wide_store = large;
            large += island.wide_count;
        }
        else
        {
            bodies += island.state_count;
            most = std::max(most, island.wide_count);
        }
        if (bodies < batch_bodies && i + 1 < scratch.solver.islands.size())
            continue;
        starts.push_back(static_cast<std::int32_t>(i) + 1);
        store += most;
        most = 0;
        bodies = 0;
    }
    std::int32_t blocks = store + large;
    for (Island& island : scratch.solver.islands)
    {
        island.wide_store += is_shared(island) ? store : 0; // the large ones come behind
        if (scratch.cached_constraints.are_valid)
        {
            island.wide_store = island.first_wide;
            blocks = island.first_wide + island.wide_count;
        }
    }
    scratch.solver.wide_contacts.make_room(static_cast<std::size_t>(blocks));
    scratch.solver.wide_notes.make_room(static_cast<std::size_t>(blocks));
    scratch.solver.wide_features.make_room(static_cast<std::size_t>(blocks));
    set_size(scratch.solver.struck, scratch.solver.wide_contacts.size());
    set_size(scratch.solver.relieved, scratch.solver.wide_contacts.size());
}

// All threads solve the large islands together, one after the other.
void solve_large(const StepContext& ctx, WorkerTeam& team)
{
    IslandEnergy energy;
    for (std::size_t u = 0; u < ctx.scratch.solver.islands.size(); ++u)
    {
        if (is_shared(ctx.scratch.solver.islands[u]))
            solve(ctx, u, energy, team);
    }
}

void solve_batch(const StepContext& ctx, int batch)
{
    const Scratch& scratch = ctx.scratch;
    IslandEnergy energy;
    WorkerTeam alone;
    const auto b = static_cast<std::size_t>(batch);
    for (auto u = static_cast<std::size_t>(scratch.order[b]); u < static_cast<std::size_t>(scratch.order[b + 1]); ++u)
    {
        const Island& island = scratch.solver.islands[u];
        if (island.policy.free_fall)
            advance_free_fall(ctx, island);
        else if (!is_shared(island))
            solve(ctx, u, energy, alone);
    }
}

} // namespace

void solve_islands(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    if (scratch.solver.outputs.size() < scratch.solver.islands.size())
        set_size(scratch.solver.outputs, scratch.solver.islands.size());
    for (std::size_t i = 0; i < scratch.solver.islands.size(); ++i)
        scratch.solver.outputs[i].clear();
    mark_traced(ctx);
    set_size(scratch.solver.unpushed, scratch.solver.states.size());
    scratch.solver.first_relieved.resize(scratch.solver.states.size(), none);
    set_size(scratch.solver.speeds, scratch.solver.states.size());
    set_size(scratch.solver.speeds_before_pass, scratch.solver.states.size());
    form_batches(scratch);
    const TaskHooks& tasks = ctx.scene.def.tasks;
    const int batches = static_cast<int>(scratch.order.size()) - 1;
    const auto solve_some = [&](int batch) { solve_batch(ctx, batch); };
    if (std::ranges::any_of(scratch.solver.islands, is_shared))
        WorkerTeam::run(tasks, [&](WorkerTeam& team) { solve_large(ctx, team); }, batches, solve_some);
    else
        run_tasks(tasks, batches, solve_some);
    ctx.state.lanes_stamp = ++scratch.cached_constraints.stamp;
}

} // namespace carom::internal
