#pragma once

// Contacts that a step makes and destroys, together. Slots and the list of awake contacts are one thread's, in the order of the calls. What is dear,
// records and the lists they hang in all over memory, is left for finish(): threads share it out by bodies, for a body's list is of its contacts alone.

#include "dynamics/scene_data.h"
#include "dynamics/step_context.h"

namespace carom::internal {

class ContactBatch
{
public:
    explicit ContactBatch(StepContext& ctx);

    /// Of a pair in SceneState::box_pairs of which one moves and none is a trigger, whose shapes may collide and have no contact.
    void make(std::int32_t pair);
    /// Of two that do not touch, and none is a trigger.
    void destroy(std::int32_t contact);
    /// Until then lists hold those that are destroyed, and of what is made there is a slot with its pair and its place among the awake.
    void finish();

private:
    template <class Visit>
    void for_each_side(std::span<const std::int32_t> contacts, const Visit& visit) const;
    void unlink_destroyed();
    void fill_made();
    void link_made();

    SceneData& m_scene;
    SceneState& m_state;
    std::vector<std::int32_t>& m_made;
    std::vector<std::int32_t>& m_destroyed;
};

} // namespace carom::internal
