#pragma once

// Sleep and waking. An island sleeps and wakes as a whole. While it sleeps, its boxes are in the resting layer and its contacts keep their manifolds and
// impulses untouched.

#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/scene_data.h"

namespace carom::internal {

[[nodiscard]] inline bool is_awake(const SceneState& state, int body) { return state.bodies[body].awake_index != none; }

[[nodiscard]] inline bool sleeps(const SceneState& state, int body)
{
    return state.bodies[body].type == BodyType::Dynamic && !is_awake(state, body);
}

/// Updates the sleeper flag of a contact, so that passes over all contacts need not look at the bodies.
inline void note_sleeper(const SceneState& state, Contact& contact)
{
    contact.flags &= ~contact_flag::sleeper;
    if (sleeps(state, contact.body_a) || sleeps(state, contact.body_b))
        contact.flags |= contact_flag::sleeper;
}

/// Wakes the body and everything that touches or is joined to it through dynamic bodies. Static and disabled bodies are left alone.
void wake_body(SceneData& scene, int body);

/// Puts one body to sleep: the caller takes care of the rest of its island.
void sleep_body(SceneData& scene, int body);

/// Visits every dynamic body that touches this one or is joined to it, some more than once. Disabled bodies are left out.
template <class Visit>
void for_each_neighbour(const SceneState& state, int body, Visit&& visit)
{
    const auto look_at = [&](int other)
    {
        if (other != none && state.bodies[other].type == BodyType::Dynamic && state.bodies[other].enabled)
            visit(other);
    };
    for (const int index : contacts_of(state, body))
    {
        const Contact& contact = state.contacts[index];
        if ((contact.flags & (contact_flag::touching | contact_flag::trigger)) == contact_flag::touching)
            look_at(other_body(contact, body));
    }
    for_each_joint(state, body, [&](int joint) { look_at(other_body(state.joints[joint], body)); });
}

/// Appends the bodies connected with this one, itself first, as far as belongs(other) holds, and marks them as seen (by body slot).
template <class Belongs>
void gather_island(const SceneState& state, int body, std::vector<std::uint8_t>& seen, std::vector<std::int32_t>& island,
                   const Belongs& belongs)
{
    const auto add = [&](int other)
    {
        island.push_back(other);
        seen[static_cast<std::size_t>(other)] = 1;
    };
    std::size_t next = island.size();
    add(body);
    for (; next < island.size(); ++next)
    {
        if (state.bodies[island[next]].type != BodyType::Dynamic)
            continue; // islands do not extend through it
        for_each_neighbour(state, island[next],
                           [&](int other)
                           {
                               if (seen[static_cast<std::size_t>(other)] == 0 && belongs(other))
                                   add(other);
                           });
    }
}

/// Takes a body into the simulation or out of it, without touching its neighbors: lists and layers only.
void enter_awake(SceneData& scene, int body);
void leave_awake(SceneData& scene, int body);

} // namespace carom::internal
