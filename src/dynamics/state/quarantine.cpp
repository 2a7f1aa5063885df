// Removes bodies whose motion is no longer finite.

#include "dynamics/state/quarantine.h"

#include "dynamics/sleep/wake.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <vector>

namespace carom::internal {

namespace {

// The joint loads of the step are as wrong as the body's state.
void forget_loads_of_joints(SceneState& state, int body)
{
    for (int edge = state.bodies[body].first_joint; edge != none; edge = state.joints[edge >> 1].next[edge & 1])
    {
        JointRecord& joint = state.joints[edge >> 1];
        forget_loads(joint);
        joint.knows_errors = false;
    }
}

template <class Event>
bool is_between(const Event& e, ShapeId a, ShapeId b)
{
    return (e.shape_a == a && e.shape_b == b) || (e.shape_a == b && e.shape_b == a);
}

} // namespace

void quarantine(StepContext& ctx, int body, float time)
{
    SceneState& state = ctx.state;
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    sim.velocity = {};
    sim.angular_velocity = 0;
    sim.force = {};
    sim.torque = 0;
    forget_loads_of_joints(state, body);
    for_each_contact(state, body, [&](int contact) { destroy_contact(ctx.scene, contact, ctx.scene.events, time); });
    leave_awake(ctx.scene, body);
    state.bodies[body].enabled = false;
    for_each_leaf(state, body, [&](int shape) { state.broad_phase.remove(shape); });
    ctx.report.quarantined.push_back(body_id(state, body));
    ctx.report.flags |= static_cast<std::uint32_t>(StepFlag::BodyQuarantined);
}

void forget_events_of(StepContext& ctx, std::span<const std::int32_t> bodies)
{
    Events& events = ctx.scene.events;
    const auto is_of_them = [&](const auto& e)
    {
        return std::ranges::any_of(bodies,
                                   [&](std::int32_t body)
                                   {
                                       const BodyId id = body_id(ctx.state, body);
                                       return e.body_a == id || e.body_b == id;
                                   });
    };
    std::erase_if(events.impacts, is_of_them);
    std::erase_if(events.begins,
                  [&](const ContactBeginEvent& begin)
                  {
                      if (!is_of_them(begin))
                          return false;
                      const auto end = std::ranges::find_if(events.ends, [&](const ContactEndEvent& e)
                                                            { return is_between(e, begin.shape_a, begin.shape_b); });
                      if (end != events.ends.end())
                          events.ends.erase(end);
                      return true;
                  });
}

} // namespace carom::internal
