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

RowFollower::RowFollower(const StepContext& ctx)
    : m_ctx(ctx), m_state(ctx.state), m_scratch(ctx.scratch), m_scene(followed_scene(ctx))
{}

FollowNews RowFollower::follow(WideRow& row, WideNotes& notes)
{
    FollowedRow now;
    m_kernels.follow(row, notes, m_scene, now);
    FollowNews news;
    const std::uint32_t looked = now.unsure | now.begins_or_ends;
    const std::uint32_t sure = filled_lanes(notes) & ~looked;
    notes.may_hit = now.unloaded & sure;
    clear_sums(row, notes);
    for_each_lane(sure & ~notes.followed, [&](int i) { m_state.contacts[notes.contact.v[i]].flags |= contact_flag::followed; });
    notes.followed |= sure;
    for_each_lane(now.borne & sure, [&](int i) { note_borne(row, i); });
    for_each_lane(now.sunk & sure, [&](int i) { note_if_loaded(row, notes, i, now.separation.v[i]); });
    for_each_lane(looked, [&](int i) { look_at(row, notes, i, news); });
    m_kernels.prepare(row, notes.count);
    return news;
}

// Found anew, or followed, by itself.
void RowFollower::look_at(WideRow& row, WideNotes& notes, int i, FollowNews& news)
{
    const std::uint32_t bit = 1u << i;
    const std::int32_t index = notes.contact.v[i];
    m_scratch.is_looked_at[static_cast<std::size_t>(index)] = 1;
    const Contact& contact = m_state.contacts[index];
    if (update_contact(m_ctx, index) != News::Nothing)
        news.told |= bit;
    if (!is_solved(contact) || contact.manifold.count != notes.count)
    {
        news.gone |= bit;
        return;
    }
    Link link;
    link.contact = index;
    link.a = row.a.v[i];
    link.b = row.b.v[i];
    refill_lane(m_ctx, link, row, notes, i);
    note_if_loaded(row, notes, i, least_separation(contact.manifold));
}

// What is not borne may fly.
void RowFollower::note_borne(const WideRow& row, int i) const
{
    for (const std::int32_t s : {row.a.v[i], row.b.v[i]})
        std::atomic_ref(m_scratch.borne[static_cast<std::size_t>(s)]).store(1, std::memory_order_relaxed);
}

void RowFollower::note_if_loaded(const WideRow& row, const WideNotes& notes, int i, float separation) const
{
    if (is_loaded(m_ctx, m_state.contacts[notes.contact.v[i]], separation))
        note_borne(row, i);
}

} // namespace carom::internal
