#pragma once

// Contacts that a step makes and destroys, together. Slots and the list of awake contacts are one thread's, in the order of the calls; where there are many,
// all of the step's in finish(), so that the list stays in the order of slots that tidy() gave it. What is dear, records and the lists they hang in all over
// memory, is always left for finish(): threads share it out by bodies, for a body's list is of its contacts alone.

#include "dynamics/state/scene_data.h"
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
    /// Until then lists of bodies hold those that are destroyed and not those that are made.
    void finish();

private:
    template <class Visit>
    void for_each_side(std::span<const std::int32_t> contacts, const Visit& visit) const;
    void unlink_destroyed();
    void find_slots();
    std::int32_t take_over(std::int32_t contact, std::int32_t pair);
    std::int32_t take_slot(std::int32_t pair);
    void join_pair(std::int32_t contact, std::int32_t pair);
    void give_up(std::size_t first, std::size_t last);
    void fill_made();
    void link_made();

    SceneData& m_scene;
    SceneState& m_state;
    std::vector<std::int32_t>& m_made; ///< in finish() contacts; until then pairs where the order is kept
    std::vector<std::int32_t>& m_destroyed;
    bool m_keeps_order;
};

} // namespace carom::internal
