// Refreshes wide contact constraints through a kernel. Contacts that it cannot decide are updated one by one.

#include "dynamics/narrowphase/constraint_refresh.h"

#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/narrowphase/manifold_cache.h"
#include "dynamics/solver/contact/prepare_wide.h"
#include "dynamics/state/scene_data.h"

#include <atomic>
#include <bit>

namespace carom::internal {

namespace {

template <class Visit>
void for_each_lane(std::uint32_t lanes, const Visit& visit)
{
    for (; lanes != 0; lanes &= lanes - 1)
        visit(std::countr_zero(lanes));
}

} // namespace

ConstraintRefresh::ConstraintRefresh(const StepContext& ctx)
    : m_ctx(ctx), m_state(ctx.state), m_scratch(ctx.scratch), m_scene(followed_scene(ctx))
{}

RefreshChanges ConstraintRefresh::follow(std::size_t at)
{
    WideContact& constraint = m_scratch.solver.wide_contacts[at];
    WideContactNotes& notes = m_scratch.solver.wide_notes[at];
    RefreshedContacts now;
    m_kernels.follow(constraint, notes, m_scene, now);
    RefreshChanges changes;
    const std::uint32_t looked = now.unsure | now.begins_or_ends;
    const std::uint32_t sure = filled_lanes(notes) & ~looked;
    clear_sums(constraint, notes);
    for_each_lane(sure & ~std::uint32_t{notes.followed},
                  [&](int i) { m_state.contacts[notes.contact.v[i]].flags |= contact_flag::followed; });
    notes.followed = static_cast<std::uint16_t>(notes.followed | sure);
    for_each_lane(now.borne & sure, [&](int i) { note_borne(constraint, i); });
    for_each_lane(now.sunk & sure, [&](int i) { note_if_loaded(constraint, notes, i, now.separation.v[i]); });
    for_each_lane(looked, [&](int i) { look_at(at, i, changes); });
    m_kernels.prepare(constraint, notes, m_scene.sims, m_ctx.dt, halfway_gap(m_ctx));
    return changes;
}

// Updates the contact of one lane by itself and refills the lane.
void ConstraintRefresh::look_at(std::size_t at, int i, RefreshChanges& changes)
{
    WideContact& constraint = m_scratch.solver.wide_contacts[at];
    WideContactNotes& notes = m_scratch.solver.wide_notes[at];
    const std::uint32_t bit = 1u << i;
    const std::int32_t index = notes.contact.v[i];
    m_scratch.narrow.is_looked_at[static_cast<std::size_t>(index)] = 1;
    const Contact& contact = m_state.contacts[index];
    if (update_contact(m_ctx, index) != TouchChange::Nothing)
        changes.told |= bit;
    if (!is_solved(contact) || contact.manifold.count != notes.count)
    {
        changes.gone |= bit;
        return;
    }
    refill_lane(m_ctx, at, i);
    note_if_loaded(constraint, notes, i, least_separation(contact.manifold));
}

// A body that is not borne may fly.
void ConstraintRefresh::note_borne(const WideContact& constraint, int i) const
{
    for (const std::int32_t s : {constraint.a.v[i], constraint.b.v[i]})
        std::atomic_ref(m_scratch.narrow.borne[static_cast<std::size_t>(s)]).store(1, std::memory_order_relaxed);
}

void ConstraintRefresh::note_if_loaded(const WideContact& constraint, const WideContactNotes& notes, int i,
                                       float separation) const
{
    if (is_loaded(m_ctx, m_state.contacts[notes.contact.v[i]], separation))
        note_borne(constraint, i);
}

} // namespace carom::internal
