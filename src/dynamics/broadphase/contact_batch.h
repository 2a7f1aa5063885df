#pragma once

// Contacts that a step creates and destroys, in one batch. One thread changes slots and the list of awake contacts, in the order of the calls. Where there are
// many contacts, it does so in finish(), so that the list keeps the slot order that reorder.cpp gave it. The expensive part is always left for finish():
// records, and the lists that link them all over memory. Threads share it by bodies, because the list of a body holds its contacts only.

#include "dynamics/state/scene_data.h"
#include "dynamics/step_context.h"

namespace carom::internal {

class ContactBatch
{
public:
    explicit ContactBatch(StepContext& ctx);

    /// For a pair in SceneState::box_pairs, of which at least one shape moves and none is a trigger, whose shapes may collide and have no contact.
    void make(std::int32_t pair);
    /// For a contact of two shapes that do not touch, neither of them a trigger.
    void destroy(std::int32_t contact);
    /// Until this call, lists of bodies hold the destroyed contacts but not the new ones.
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
    std::vector<std::int32_t>& m_made; ///< contacts in finish(); until then, pairs where the order is kept
    std::vector<std::int32_t>& m_destroyed;
    bool m_keeps_order;
};

} // namespace carom::internal
