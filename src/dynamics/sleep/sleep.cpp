// The last part of stage 6: bodies come to rest, islands fall asleep, and forces and targets that apply to this step alone are cleared.

#include "core/grow.h"
#include "core/nonzero.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/stages.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

constexpr float rest_damping_speed = 0.2f; // share of the sleep speed
constexpr float rest_damping_time = 0.5f;  // s
constexpr float at_rest = 0.05f;           // share of the sleep speed, over time_to_stay
constexpr float time_to_stay = 0.25f;      // s, in one place
constexpr float time_to_sleep = 0.5f;      // s: long enough for a body at the top of its flight not to fall asleep

// Twice in the time it takes to fall asleep. In each step of 1/60 s, the search costs a twentieth in a pile where some bodies never rest.
bool looks_for_islands(const StepContext& ctx)
{
    const double steps_between = 0.5 * static_cast<double>(time_to_sleep) / static_cast<double>(ctx.dt);
    const auto steps = static_cast<std::uint64_t>(std::clamp(std::round(steps_between), 1.0, 1e9));
    return ctx.state.step_count % steps == 0;
}

bool hangs_on_spring(const SceneState& state, const BodyRecord& record)
{
    for (int edge = record.first_joint; edge != none; edge = state.joints[edge >> 1].next[edge & 1])
    {
        if (state.joints[edge >> 1].kind == JointType::Spring)
            return true;
    }
    return false;
}

bool bears_load_in_pile(const StepContext& ctx, const BodySim& sim)
{
    return sim.caches_manifolds && sim.gravity_scale * ctx.state.gravity != Vec2{};
}

void slow_down(BodySim& sim, float by)
{
    sim.velocity *= by;
    sim.angular_velocity *= by;
}

// A slower body is quiet.
float quiet_speed(const SceneState& state, const BodyRecord& record)
{
    if (record.type == BodyType::Kinematic)
        return 0;
    const float share = hangs_on_spring(state, record) ? 0.02f : 1; // a damped spring approaches its rest length slowly
    return share * record.sleep_speed;
}

// A body that rocks comes back to where it was. A body that drifts, rolls, slips or is pushed out of an overlap has moved on, however slowly.
bool has_stayed(const BodySim& sim, const QuietStart& start, float speed)
{
    const float turn = std::fabs((sim.rotation * inverse(start.rotation)).s);
    return std::max(length(sim.center - start.center), turn * sim.extent) <= at_rest * speed * (sim.sleep_time - start.time);
}

// Counts the time for which a body has been slow. The body is tired from time_to_sleep on, if it has also stayed where it was for the last part of that.
void count_quiet_time(const StepContext& ctx, int body, BodySim& sim, float speed)
{
    QuietStart& start = ctx.state.quiet_starts[static_cast<std::size_t>(body)];
    if (sim.sleep_time == 0)
        start = {sim.previous_center, sim.previous_rotation, 0};
    sim.sleep_time += ctx.dt;
    if (sim.sleep_time < start.time + time_to_stay)
        return;
    if (!has_stayed(sim, start, speed))
        sim.sleep_time = std::min(sim.sleep_time, time_to_sleep - time_to_stay);
    sim.sleep_time = std::min(sim.sleep_time, time_to_sleep);
    start = {sim.center, sim.rotation, sim.sleep_time};
}

// Rest damping: in a pile nothing rolls or rocks forever. A body that has been quiet for as long as it takes to fall asleep, and moves slowly, comes to rest
// even where it may not sleep because others move or sleeping is off.
void settle_or_stir(const StepContext& ctx, int body, BodySim& sim)
{
    const float speed = std::max(length(sim.velocity), std::fabs(sim.angular_velocity) * sim.extent);
    if (speed > ctx.state.greatest_sleep_speed)
    { // faster than the sleep speed of any body
        sim.sleep_time = 0;
        return;
    }
    const BodyRecord& record = ctx.state.bodies[body];
    const float limit = quiet_speed(ctx.state, record);
    const bool is_quiet = speed <= limit && record.can_sleep && !record.has_target;
    if (is_quiet)
        count_quiet_time(ctx, body, sim, record.sleep_speed);
    else
        sim.sleep_time = 0;
    if (sim.sleep_time >= time_to_sleep && speed < rest_damping_speed * limit && record.type == BodyType::Dynamic &&
        bears_load_in_pile(ctx, sim))
        slow_down(sim, std::max(1 - ctx.dt / rest_damping_time, 0.0f));
}

// A body that leans on a moving kinematic body, or is joined to it, is carried by it, however slowly.
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
    for_each_joint(state, body,
                   [&](int joint)
                   {
                       if (const int other = other_body(state.joints[joint], body); other != none)
                           state.sims[static_cast<std::size_t>(other)].sleep_time = 0;
                   });
}

// A target applies to one step, in which it has been reached.
void forget_target(SceneState& state, int body)
{
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    BodyTarget& target = state.targets[static_cast<std::size_t>(body)];
    target.velocity = std::exchange(sim.velocity, Vec2{});
    target.angular_velocity = std::exchange(sim.angular_velocity, 0.0f);
    state.bodies[body].has_target = false;
}

void settle_kinematic_bodies(SceneState& state, bool keeps_awake)
{
    for (const std::int32_t body : state.awake_bodies)
    {
        if (state.bodies[body].type != BodyType::Kinematic)
            continue;
        if (keeps_awake)
            keep_carried_awake(state, body);
        state.bodies[body].had_target = state.bodies[body].has_target;
        if (state.bodies[body].has_target)
            forget_target(state, body);
    }
}

// Connected tired bodies fall asleep, unless one of them has a neighbor that is awake and not tired.
class TiredIslands
{
public:
    explicit TiredIslands(StepContext& ctx)
        : m_ctx(ctx), m_state(ctx.state), m_sets(ctx.scratch.graph.sets), m_is_tired(ctx.scratch.sleep.is_tired),
          m_is_kept_awake(ctx.scratch.sleep.is_kept_awake)
    {}

    void put_to_sleep()
    {
        find_tired();
        join_at_contacts();
        for (int j = 0; j < m_state.joints.capacity(); ++j)
        {
            if (m_state.joints.is_live(j))
                link(m_state.joints[j].body_a, m_state.joints[j].body_b);
        }
        std::vector<std::int32_t>& sleepers = m_ctx.scratch.order;
        list_sleepers(sleepers);
        for (const std::int32_t body : sleepers)
            sleep_body(m_ctx.scene, body);
    }

private:
    void find_tired()
    {
        const std::size_t count = m_state.awake_bodies.size();
        m_sets.reset(count);
        set_size(m_is_tired, count);
        m_is_kept_awake.assign(count, 0);
        for_each_in_chunks(m_ctx.scene.def.tasks, count, bodies_per_task,
                           [&](std::size_t i)
                           {
                               const auto body = static_cast<std::size_t>(m_state.awake_bodies[i]);
                               m_is_tired[i] = m_state.sims[body].sleep_time >= time_to_sleep ? 1 : 0;
                           });
    }

    void join_at_contacts()
    {
        for_each_in_chunks(m_ctx.scene.def.tasks, m_state.awake_contacts.size(), contacts_per_task,
                           [&](std::size_t i)
                           {
                               if (i + prefetch_distance < m_state.awake_contacts.size())
                                   prefetch_line(&m_state.contacts[m_state.awake_contacts[i + prefetch_distance]]);
                               const Contact& contact = m_state.contacts[m_state.awake_contacts[i]];
                               if (touches(contact))
                                   link(contact.body_a, contact.body_b);
                           });
    }

    // Runs on all threads.
    void link(std::int32_t body_a, std::int32_t body_b)
    {
        const std::int32_t a = place_of(body_a);
        const std::int32_t b = place_of(body_b);
        if (a == none || b == none)
            return;
        const bool a_is_tired = m_is_tired[static_cast<std::size_t>(a)] != 0;
        const bool b_is_tired = m_is_tired[static_cast<std::size_t>(b)] != 0;
        if (a_is_tired && b_is_tired)
            m_sets.link(a, b, true);
        else if (a_is_tired != b_is_tired)
            std::atomic_ref(m_is_kept_awake[static_cast<std::size_t>(a_is_tired ? a : b)]).store(1, std::memory_order_relaxed);
    }

    // The awake index of a body that is dynamic and awake: only such bodies form islands.
    [[nodiscard]] std::int32_t place_of(std::int32_t body) const
    {
        return body != none && m_state.bodies[body].type == BodyType::Dynamic ? m_state.bodies[body].awake_index : none;
    }

    void list_sleepers(std::vector<std::int32_t>& sleepers)
    {
        const auto of_set = [&](std::size_t i) -> std::uint8_t&
        { return m_is_kept_awake[static_cast<std::size_t>(m_sets.root(static_cast<std::int32_t>(i)))]; };
        for_each_nonzero(m_is_kept_awake.data(), m_is_kept_awake.size(), [&](std::size_t i) { of_set(i) = 1; });
        sleepers.clear();
        for_each_nonzero(m_is_tired.data(), m_is_tired.size(),
                         [&](std::size_t i)
                         {
                             if (of_set(i) == 0)
                                 sleepers.push_back(m_state.awake_bodies[i]);
                         });
    }

    StepContext& m_ctx;
    SceneState& m_state;
    UnionFind& m_sets;
    std::vector<std::uint8_t>& m_is_tired;      ///< by awake index
    std::vector<std::uint8_t>& m_is_kept_awake; ///< whether an awake neighbor keeps it awake; finally, by root of a set
};

} // namespace

void settle_bodies(StepContext& ctx)
{
    SceneState& state = ctx.state;
    std::atomic<bool> any_tired{false};
    for_each_in_chunks(ctx.scene.def.tasks, state.awake_bodies.size(), bodies_per_task,
                       [&](std::size_t i)
                       {
                           const std::int32_t body = state.awake_bodies[i];
                           BodySim& sim = state.sims[static_cast<std::size_t>(body)];
                           settle_or_stir(ctx, body, sim);
                           if (sim.sleep_time >= time_to_sleep)
                               raise(any_tired);
                           sim.force = {};
                           sim.torque = 0;
                       });
    const bool looks = ctx.scene.def.sleeping && looks_for_islands(ctx);
    if (ctx.scratch.graph.has_kinematic)
        settle_kinematic_bodies(state, looks);
    if (looks && any_tired)
        TiredIslands(ctx).put_to_sleep();
}

} // namespace carom::internal
