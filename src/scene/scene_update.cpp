// A frame: as many fixed steps as its time requires, the events of all of them, and forces that act for its time.

#include "core/grow.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "scene/access.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace carom {

using namespace internal;

namespace {

/// The time of a frame, s: the part that its steps cover, and the part that waits for the next step.
struct FrameTime
{
    double acts = 0;
    double waits = 0;
    double stepped = 0; ///< time of its steps, which also cover what had waited before
};

/// Force on one body, through each step of the frame.
struct FrameForce
{
    BodyId body{};
    Vec2 force{};
    float torque = 0;
};

WaitingForce& waiting_force(SceneState& state, int body)
{
    grow(state.waiting_forces, static_cast<std::size_t>(body) + 1);
    return state.waiting_forces[static_cast<std::size_t>(body)];
}

// Forces that were applied since the last frame act for the time of this one. The part of it that no step covers yet is kept as an impulse.
std::vector<FrameForce> take_forces(SceneState& state, const FrameTime& time)
{
    for (const std::int32_t body : state.awake_bodies)
    {
        BodySim& sim = state.sims[static_cast<std::size_t>(body)];
        if (sim.force == Vec2{} && sim.torque == 0)
            continue;
        WaitingForce& f = waiting_force(state, body);
        f.force = std::exchange(sim.force, Vec2{});
        f.torque = std::exchange(sim.torque, 0.0f);
    }
    std::vector<FrameForce> given;
    for (std::size_t body = 0; body < state.waiting_forces.size(); ++body)
    {
        WaitingForce& f = state.waiting_forces[body];
        if (f == WaitingForce{})
            continue;
        if (time.stepped > 0)
        {
            const auto acts = static_cast<float>(time.acts);
            const auto over_steps = static_cast<float>(1 / time.stepped);
            given.push_back({body_id(state, static_cast<int>(body)), over_steps * (f.impulse + acts * f.force),
                             over_steps * (f.twist + acts * f.torque)});
            f.impulse = {};
            f.twist = 0;
        }
        const auto waits = static_cast<float>(time.waits);
        f = {.impulse = f.impulse + waits * f.force, .twist = f.twist + waits * f.torque};
    }
    return given;
}

void give(SceneData& data, const std::vector<FrameForce>& forces)
{
    for (const FrameForce& f : forces)
    {
        if (!is_live(data.state, f.body) || data.state.bodies[slot_of(f.body)].type != BodyType::Dynamic)
            continue;
        BodySim& sim = data.state.sims[static_cast<std::size_t>(slot_of(f.body))];
        sim.force += f.force;
        sim.torque += f.torque;
        wake_body(data, slot_of(f.body));
    }
}

template <class Event>
void append_events(const std::vector<Event>& from, std::vector<Event>& to)
{
    to.insert(to.end(), from.begin(), from.end());
}

/// Collects the events of all steps of a frame, also if a callback throws out of one of them.
class FrameEvents
{
public:
    explicit FrameEvents(SceneData& data) : m_data(data) {}
    ~FrameEvents()
    {
        m_data.frame_step = 0;
        std::swap(m_data.events, m_of_all);
    }
    FrameEvents(const FrameEvents&) = delete;
    FrameEvents& operator=(const FrameEvents&) = delete;

    /// Runs a step and takes its events; an exception may end it early.
    template <class Step>
    void of(int step, const Step& run)
    {
        struct Take
        {
            FrameEvents& all;
            ~Take() { all.take(); }
        };
        m_data.frame_step = step;
        m_data.events.clear();
        const Take take{*this};
        run();
    }

private:
    void take()
    {
        const Events& of_step = m_data.events;
        append_events(of_step.begins, m_of_all.begins);
        append_events(of_step.ends, m_of_all.ends);
        append_events(of_step.impacts, m_of_all.impacts);
        append_events(of_step.enters, m_of_all.enters);
        append_events(of_step.exits, m_of_all.exits);
    }

    SceneData& m_data;
    Events m_of_all;
};

} // namespace

UpdateResult Scene::update(float frame_time, const BeforeStep& before_step)
{
    const Checker check{"Scene::update"};
    if (!check.not_negative("frame_time", frame_time) ||
        !check.holds(!m_data->stepping, "the scene", "in a step", "callbacks must not step it"))
        return {};
    const SceneDef& def = m_data->def;
    double& accumulator = m_data->state.accumulator;
    const bool dropped = frame_time > def.max_frame_time;
    const double frame = static_cast<double>(dropped ? def.max_frame_time : frame_time);
    accumulator += frame;
    // A frame of exactly n steps runs n steps, whatever the rounding of the sum.
    const double step_time = def.fixed_step;
    const double rounding = 1e-6 * step_time;
    UpdateResult result;
    double left_over = accumulator;
    for (; left_over + rounding >= step_time; left_over -= step_time)
        ++result.steps;
    const double waits = std::clamp(left_over, 0.0, frame);
    const std::vector<FrameForce> forces = take_forces(m_data->state, {frame - waits, waits, result.steps * step_time});
    FrameEvents events(*m_data);
    for (int i = 0; i < result.steps; ++i)
    {
        accumulator -= step_time;
        events.of(i,
                  [&]
                  {
                      give(*m_data, forces);
                      if (before_step)
                          before_step(*this);
                      step(def.fixed_step);
                  });
    }
    accumulator = std::max(accumulator, 0.0);
    if (dropped)
        m_data->report.flags |= static_cast<std::uint32_t>(StepFlag::TimeDropped);
    result.alpha = static_cast<float>(std::min(accumulator / step_time, 1.0));
    return result;
}

} // namespace carom
