#include "dynamics/contact_batch.h"

#include "core/grow.h"
#include "core/index.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/contact_colors.h"
#include "dynamics/contact_store.h"

#include <span>

namespace carom::internal {

namespace {

constexpr std::size_t enough = 128; // contacts to share
constexpr std::size_t contacts_per_fill = 128;

// Of one side: its body, and who stands beside it in that one's list.
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
    : m_scene(ctx.scene), m_state(ctx.state), m_made(ctx.scratch.made_contacts), m_destroyed(ctx.scratch.destroyed_contacts)
{
    m_made.clear();
    m_destroyed.clear();
}

void ContactBatch::make(std::int32_t pair)
{
    const int contact = m_state.contacts.take();
    m_state.box_pairs[as_index(pair)].contact = contact;
    m_state.contacts[contact].pair = pair;
    m_state.contacts[contact].awake_index = static_cast<std::int32_t>(m_state.awake_contacts.size());
    append(m_state.awake_contacts, contact);
    append(m_made, contact);
}

void ContactBatch::destroy(std::int32_t contact)
{
    give_up_slot(m_state, contact);
    append(m_destroyed, contact);
}

void ContactBatch::finish()
{
    unlink_destroyed(); // before their slots are filled anew
    fill_made();
    link_made();
}

// Each side by the task that has its body. What stands of the other side is somebody else's to read and write.
template <class Visit>
void ContactBatch::for_each_side(std::span<const std::int32_t> contacts, const Visit& visit) const
{
    const TaskHooks& hooks = m_scene.def.tasks;
    const int tasks = contacts.size() < enough ? 1 : hooks.worker_count;
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
                      if (i + 2 * turns_ahead < contacts.size())
                          prefetch_line(&m_state.contacts[contacts[i + 2 * turns_ahead]]);
                      if (i + turns_ahead < contacts.size())
                          for_own_sides(i + turns_ahead,
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
    for_each_in_parts(m_scene.def.tasks, m_made.size(), contacts_per_fill,
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
