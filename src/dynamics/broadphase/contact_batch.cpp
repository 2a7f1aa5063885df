// Creates and destroys the contacts of a step in one batch.

#include "dynamics/broadphase/contact_batch.h"

#include "core/assert.h"
#include "core/grow.h"
#include "core/index.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/state/coloring.h"
#include "dynamics/state/contact_store.h"

#include <span>
#include <utility>
#include <vector>

namespace carom::internal {

namespace {

constexpr std::size_t enough_contacts = 128; // contacts that are worth sharing among threads
constexpr std::size_t contacts_per_fill = 128;

// Prefetches the body of one side, and the neighbors of the contact in that body's list.
[[gnu::always_inline]] inline void prefetch_side(const SceneState& state, const Contact& contact, int side)
{
    prefetch(state.bodies[side == 0 ? contact.body_a : contact.body_b]);
    for (const std::int32_t edge : {contact.next[side], contact.previous[side]})
    {
        if (edge != none)
            prefetch_line(&state.contacts[edge >> 1]);
    }
}

} // namespace

ContactBatch::ContactBatch(StepContext& ctx)
    : m_scene(ctx.scene), m_state(ctx.state), m_made(ctx.scratch.broad.made_contacts),
      m_destroyed(ctx.scratch.broad.destroyed_contacts), m_keeps_order(ctx.state.awake_contacts.size() > most_near_pairs)
{
    m_made.clear();
    m_destroyed.clear();
}

void ContactBatch::make(std::int32_t pair) { append(m_made, m_keeps_order ? pair : take_slot(pair)); }

void ContactBatch::destroy(std::int32_t contact)
{
    if (!m_keeps_order)
        give_up_slot(m_state, contact);
    append(m_destroyed, contact);
}

void ContactBatch::finish()
{
    unlink_destroyed(); // before their slots are reused
    if (m_keeps_order)
        find_slots();
    fill_made();
    link_made();
}

// New and destroyed contacts both come in the order of pairs, in which neighbors are mostly adjacent. So the i-th new contact takes the slot of the
// corresponding destroyed one, and its index among the awake contacts. Surplus new contacts come last; surplus destroyed ones leave gaps. The other contacts
// keep their order.
void ContactBatch::find_slots()
{
    const std::size_t gone = m_destroyed.size();
    std::size_t next = 0;
    for (std::size_t i = 0; i < m_made.size(); ++i)
    {
        const std::size_t end = gone * (i + 1) / m_made.size();
        m_made[i] = next < end ? take_over(m_destroyed[next++], m_made[i]) : take_slot(m_made[i]);
        give_up(next, end);
        next = end;
    }
    give_up(next, gone);
    // Contacts behind a gap get their new index in update_contacts. It visits all of them: there are fewer contacts than when the constraints were cached, so
    // the cache does not hold.
    if (gone > m_made.size())
        std::erase(m_state.awake_contacts, none);
}

std::int32_t ContactBatch::take_over(std::int32_t contact, std::int32_t pair)
{
    leave_pair(m_state, contact);
    leave_lane(m_state, contact);
    m_state.contacts.renew(contact);
    join_pair(contact, pair);
    return contact;
}

std::int32_t ContactBatch::take_slot(std::int32_t pair)
{
    const int contact = m_state.contacts.take();
    join_pair(contact, pair);
    m_state.contacts[contact].awake_index = static_cast<std::int32_t>(m_state.awake_contacts.size());
    append(m_state.awake_contacts, contact);
    return contact;
}

void ContactBatch::join_pair(std::int32_t contact, std::int32_t pair)
{
    m_state.box_pairs[as_index(pair)].contact = contact;
    m_state.contacts[contact].pair = pair;
}

// Destroyed contacts first ... last each leave a gap among the awake contacts.
void ContactBatch::give_up(std::size_t first, std::size_t last)
{
    for (const std::int32_t contact : std::span(m_destroyed).subspan(first, last - first))
    {
        const auto place = as_index(std::exchange(m_state.contacts[contact].awake_index, none));
        CAROM_ASSERT(m_state.awake_contacts[place] == contact, "what is destroyed here is awake");
        m_state.awake_contacts[place] = none;
        leave_lane(m_state, contact);
        give_up_slot(m_state, contact);
    }
}

// Each side is visited by the task that owns its body. Links of the other side belong to another task, to read and to write.
template <class Visit>
void ContactBatch::for_each_side(std::span<const std::int32_t> contacts, const Visit& visit) const
{
    const TaskHooks& hooks = m_scene.def.tasks;
    const int tasks = contacts.size() < enough_contacts ? 1 : hooks.worker_count;
    const auto bound = [&](int task) { return std::int64_t{m_state.bodies.capacity()} * task / tasks; };
    run_tasks(hooks, tasks,
              [&](int task)
              {
                  const auto for_own_sides = [&, first = bound(task), last = bound(task + 1)](std::size_t i, const auto& work)
                  {
                      const Contact& contact = m_state.contacts[contacts[i]];
                      if (contact.body_a >= first && contact.body_a < last)
                          work(contact, 0);
                      if (contact.body_b >= first && contact.body_b < last)
                          work(contact, 1);
                  };
                  for (std::size_t i = 0; i < contacts.size(); ++i)
                  {
                      if (i + 2 * prefetch_distance < contacts.size())
                          prefetch_line(&m_state.contacts[contacts[i + 2 * prefetch_distance]]);
                      if (i + prefetch_distance < contacts.size())
                          for_own_sides(i + prefetch_distance,
                                        [&](const Contact& contact, int side) { prefetch_side(m_state, contact, side); });
                      for_own_sides(i, [&](const Contact&, int side) { visit(contacts[i], side); });
                  }
              });
}

void ContactBatch::unlink_destroyed()
{
    for_each_side(m_destroyed,
                  [&](std::int32_t contact, int side)
                  {
                      if (side == 0)
                          leave_color(m_state, m_state.contacts[contact]);
                      unlink_side(m_state, contact, side);
                  });
}

void ContactBatch::fill_made()
{
    make_room_beside_contacts(m_state);
    for_each_in_chunks(m_scene.def.tasks, m_made.size(), contacts_per_fill,
                       [&](std::size_t i)
                       {
                           Contact& contact = m_state.contacts[m_made[i]];
                           const std::int32_t index = contact.pair;
                           const std::int32_t awake_index = contact.awake_index;
                           const BoxPair& pair = m_state.box_pairs[as_index(index)];
                           contact = new_contact(m_scene, pair.a, pair.b, index);
                           contact.awake_index = awake_index;
                           impulses_of(m_state, m_made[i]) = {};
                       });
}

void ContactBatch::link_made()
{
    for_each_side(m_made, [&](std::int32_t contact, int side) { link_side(m_state, contact, side); });
}

} // namespace carom::internal
