// The last of stage 6: bodies come to rest, islands fall asleep, and what a user asked for this step alone is forgotten.

#include "core/task_pool.h"
#include "dynamics/body_store.h"
#include "dynamics/contact_store.h"
#include "dynamics/stages.h"
#include "dynamics/wake.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace carom::internal {

namespace {

constexpr std::size_t bodies_per_task = 512;
constexpr float creeping = 0.2f;                 // of the sleep speed
constexpr float creep_time = 0.5f;               // s
constexpr float time_to_sleep = 0.5f;            // s: long enough for a body at the top of its flight not to fall asleep
constexpr std::uint64_t steps_between_sleep = 8; // to look for islands in each costs a pile of which some never rest a twentieth

bool looks_for_islands(const SceneState& state) { return state.step_count % steps_between_sleep == 0; }

bool hangs_on_spring(const SceneState& state, const BodyRecord& record)
{
    for (int edge = record.first_joint; edge != none; edge = state.joints[edge >> 1].next[edge & 1])
    {
        if (state.joints[edge >> 1].kind == JointType::Spring)
            return true;
    }
    return false;
}

bool bears_in_crowd(const StepContext& ctx, const BodySim& sim)
{
    return sim.crowded && sim.gravity_scale * ctx.state.gravity != Vec2{};
}

void slow_down(BodySim& sim, float by)
{
    sim.velocity *= by;
    sim.angular_velocity *= by;
}

// What is slower is quiet.
float quiet_speed(const StepContext& ctx, const BodyRecord& record)
{
    if (record.type == BodyType::Kinematic)
        return 0;
    const float limit = ctx.scene.tolerances.sleep_speed;
    return hangs_on_spring(ctx.state, record) ? 0.02f * limit : limit; // a damped spring creeps the last of its way
}

// In a pile nothing rolls or rocks on for ever: what has been quiet for as long as it takes to fall asleep, and creeps, comes to rest even where it
// may not sleep, because others move or sleeping is off.
void settle_or_stir(const StepContext& ctx, int body, BodySim& sim)
{
    const float speed = std::max(length(sim.velocity), std::fabs(sim.angular_velocity) * sim.extent);
    if (speed > ctx.scene.tolerances.sleep_speed)
    { // whatever it is
        sim.sleep_time = 0;
        return;
    }
    const BodyRecord& record = ctx.state.bodies[body];
    const float limit = quiet_speed(ctx, record);
    const bool is_quiet = speed <= limit && record.can_sleep && !record.has_target;
    sim.sleep_time = is_quiet ? sim.sleep_time + ctx.dt : 0;
    if (sim.sleep_time >= time_to_sleep && speed < creeping * limit && record.type == BodyType::Dynamic &&
        bears_in_crowd(ctx, sim))
        slow_down(sim, std::max(1 - ctx.dt / creep_time, 0.0f));
}

// What leans on a moving kinematic body is carried by it, however slowly.
void keep_carried_awake(SceneState& state, int body)
{
    const BodySim& carrier = state.sims[static_cast<std::size_t>(body)];
    if (carrier.velocity == Vec2{} && carrier.angular_velocity == 0)
        return;
    for_each_contact(state, body,
                     [&](int index)
                     {
                         const Contact& contact = state.contacts[index];
                         const std::uint32_t kind = contact.flags & (contact_flag::touching | contact_flag::trigger);
                         if (kind == contact_flag::touching)
                             state.sims[static_cast<std::size_t>(other_body(contact, body))].sleep_time = 0;
                     });
}

// A target is for one step, in which it has been reached.
void forget_target(SceneState& state, int body)
{
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    sim.velocity = {};
    sim.angular_velocity = 0;
    state.bodies[body].has_target = false;
}

// Often enough that nothing carried grows tired.
void settle_kinematic_bodies(StepContext& ctx)
{
    SceneState& state = ctx.state;
    const bool is_time = looks_for_islands(state) || ctx.dt * static_cast<float>(steps_between_sleep) >= time_to_sleep;
    const bool keeps_awake = ctx.scene.def.sleeping && is_time;
    for (const std::int32_t body : state.awake_bodies)
    {
        if (state.bodies[body].type != BodyType::Kinematic)
            continue;
        if (keeps_awake)
            keep_carried_awake(state, body);
        if (state.bodies[body].has_target)
            forget_target(state, body);
    }
}

bool is_tired(const SceneState& state, int body)
{
    return state.sims[static_cast<std::size_t>(body)].sleep_time >= time_to_sleep;
}

// What hangs together through the tired sleeps, unless one of it has a neighbour who is awake and not tired.
void put_islands_to_sleep(StepContext& ctx)
{
    SceneState& state = ctx.state;
    std::vector<std::int32_t>& tired = ctx.scratch.tired; // island by island
    std::vector<std::uint8_t>& seen = ctx.scratch.seen;
    std::vector<std::int32_t>& sleepers = ctx.scratch.order;
    tired.clear();
    sleepers.clear();
    seen.resize(std::max(seen.size(), static_cast<std::size_t>(state.bodies.capacity())));
    for (const std::int32_t body : state.awake_bodies)
    {
        if (seen[static_cast<std::size_t>(body)] != 0 || !is_tired(state, body))
            continue;
        bool all_tired = true;
        const auto belongs = [&](int other)
        {
            if (!is_awake(state, other))
                return false;
            const bool tired_too = is_tired(state, other);
            all_tired &= tired_too;
            return tired_too;
        };
        const auto first = static_cast<std::ptrdiff_t>(tired.size());
        gather_island(state, body, seen, tired, belongs);
        if (all_tired)
            sleepers.insert(sleepers.end(), tired.begin() + first, tired.end());
    }
    for (const std::int32_t body : tired)
        seen[static_cast<std::size_t>(body)] = 0;
    std::ranges::sort(sleepers, {}, [&](std::int32_t body) { return state.bodies[body].awake_index; });
    for (const std::int32_t body : sleepers)
        sleep_body(ctx.scene, body);
}

} // namespace

void settle_bodies(StepContext& ctx)
{
    SceneState& state = ctx.state;
    std::atomic<bool> any_tired{false};
    for_each_in_parts(ctx.scene.def.tasks, state.awake_bodies.size(), bodies_per_task,
                      [&](std::size_t i)
                      {
                          const std::int32_t body = state.awake_bodies[i];
                          BodySim& sim = state.sims[static_cast<std::size_t>(body)];
                          settle_or_stir(ctx, body, sim);
                          if (sim.sleep_time >= time_to_sleep)
                              raise(any_tired);
                          if (!ctx.scene.keep_forces)
                          {
                              sim.force = {};
                              sim.torque = 0;
                          }
                      });
    if (ctx.scratch.has_kinematic)
        settle_kinematic_bodies(ctx);
    if (ctx.scene.def.sleeping && any_tired && looks_for_islands(state))
        put_islands_to_sleep(ctx);
}

} // namespace carom::internal
