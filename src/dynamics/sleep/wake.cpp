// Wakes bodies and puts them to sleep: lists of awake bodies and contacts, layers of boxes, and the walk through sleeping neighbors.

#include "dynamics/sleep/wake.h"

#include "dynamics/narrowphase/manifold_cache.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/coloring.h"
#include "dynamics/state/contact_store.h"

namespace carom::internal {

void enter_awake(SceneData& scene, int body)
{
    SceneState& state = scene.state;
    BodyRecord& record = state.bodies[body];
    if (record.awake_index != none)
        return;
    record.awake_index = static_cast<std::int32_t>(state.awake_bodies.size());
    append(state.awake_bodies, body);
    state.graph_dirty = true;
    state.sims[static_cast<std::size_t>(body)].sleep_time = 0;
    for_each_leaf(state, body,
                  [&](int shape)
                  {
                      state.broad_phase.move_to(shape, Layer::Moving);
                      look_again(state, shape); // pairs without a contact were dropped
                  });
    for_each_contact(state, body,
                     [&](int contact)
                     {
                         leave_color(state, state.contacts[contact]); // other contacts may have taken it meanwhile
                         note_sleeper(state, state.contacts[contact]);
                         leave_lane(state, contact);
                         add_awake_contact(state, contact);
                         follow_again(state, contact);
                     });
}

void leave_awake(SceneData& scene, int body)
{
    SceneState& state = scene.state;
    BodyRecord& record = state.bodies[body];
    if (record.awake_index == none)
        return;
    const auto place = static_cast<std::size_t>(record.awake_index);
    state.awake_bodies[place] = state.awake_bodies.back();
    state.bodies[state.awake_bodies[place]].awake_index = record.awake_index;
    state.awake_bodies.pop_back();
    record.awake_index = none;
    colors_of(state, body) = 0;
    state.graph_dirty = true;
    for_each_leaf(state, body, [&](int shape) { state.broad_phase.move_to(shape, Layer::Resting); });
    for_each_contact(state, body,
                     [&](int contact)
                     {
                         Contact& c = state.contacts[contact];
                         note_sleeper(state, c);
                         const bool trigger = (c.flags & contact_flag::trigger) != 0;
                         if (!trigger && !is_awake(state, other_body(c, body)))
                             remove_awake_contact(state, contact);
                     });
}

void wake_body(SceneData& scene, int body)
{
    SceneState& state = scene.state;
    if (body == none || state.bodies[body].type == BodyType::Static || !state.bodies[body].enabled)
        return;
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    sim.sleep_time = 0;
    const bool still = sim.velocity == Vec2{} && sim.angular_velocity == 0 && !state.bodies[body].has_target;
    if (is_awake(state, body) || (state.bodies[body].type == BodyType::Kinematic && still))
        return;
    // Depth first through sleeping neighbors; entering marks a body as visited.
    std::vector<std::int32_t> stack{body};
    enter_awake(scene, body);
    ++scene.report.woken;
    while (!stack.empty())
    {
        const int at = stack.back();
        stack.pop_back();
        for_each_neighbour(state, at,
                           [&](int other)
                           {
                               if (is_awake(state, other))
                                   return;
                               enter_awake(scene, other);
                               ++scene.report.woken;
                               stack.push_back(other);
                           });
    }
}

void sleep_body(SceneData& scene, int body)
{
    BodySim& sim = scene.state.sims[static_cast<std::size_t>(body)];
    for_each_contact(scene.state, body, [&](int contact) { settle_manifold(scene.state, contact); });
    sim.velocity = {};
    sim.angular_velocity = 0;
    sim.previous_center = sim.center;
    sim.previous_rotation = sim.rotation;
    leave_awake(scene, body);
    ++scene.report.slept;
}

} // namespace carom::internal
