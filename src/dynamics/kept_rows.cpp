// A wide row holds all that its contacts are: in a crowd at rest, from step to step, the same contacts with the same number of points, in the same lanes.
// Then the bodies' poses say the rest. As in kept_units.cpp it is compared, not assumed: of each contact the flags, the materials and what is kept of its
// manifold are looked at; what cannot be followed is found anew by itself, and its lane filled with that.

#include "dynamics/kept_rows.h"

#include "core/task_pool.h"
#include "dynamics/contact_store.h"
#include "dynamics/contact_update.h"
#include "dynamics/kept_manifold.h"
#include "dynamics/kept_units.h"
#include "dynamics/scene_data.h"
#include "dynamics/unit_bins.h"
#include "dynamics/wide_kernels.h"
#include "dynamics/wide_prepare.h"

#include <algorithm>
#include <atomic>
#include <bit>

namespace carom::internal {

namespace {

constexpr std::size_t units_per_task = 4;
constexpr std::size_t contacts_per_task = 512;
constexpr std::size_t states_per_task = 2048;

std::size_t as_index(std::int32_t i) { return static_cast<std::size_t>(i); }

// One of a task's rows after the other.
class RowFollower
{
public:
    explicit RowFollower(const StepContext& ctx)
        : m_ctx(ctx), m_state(ctx.state), m_scratch(ctx.scratch), m_scene(followed_scene(ctx))
    {}

    // False where its contacts are not what they were.
    bool follow(WideRow& row)
    {
        FollowedRow now;
        m_kernels.follow(row, m_scene, now);
        const std::uint32_t unsure = row.count == 2 ? now.unsure : now.unsure | beyond_margins(row, now);
        if (now.strange != 0 || (now.begins_or_ends & ~unsure) != 0)
            return false;
        row.may_hit = now.unloaded & ~unsure;
        clear_sums(row);
        for_each_lane(now.unnoted & ~unsure, [&](int i) { m_state.contacts[row.contact.v[i]].flags |= contact_flag::followed; });
        for_each_lane(now.borne & ~unsure, [&](int i) { note_borne(row, i); });
        for_each_lane(now.sunk & ~unsure, [&](int i) { note_if_loaded(row, i, now.separation.v[i]); });
        for (std::uint32_t lanes = unsure; lanes != 0; lanes &= lanes - 1)
        {
            if (!look_at(row, std::countr_zero(lanes)))
                return false;
        }
        m_kernels.prepare(&row, 1);
        return true;
    }

private:
    template <class Visit>
    static void for_each_lane(std::uint32_t lanes, const Visit& visit)
    {
        for (; lanes != 0; lanes &= lanes - 1)
            visit(std::countr_zero(lanes));
    }

    // Lanes of one point that may get a second, as follow_manifold decides.
    [[nodiscard]] std::uint32_t beyond_margins(const WideRow& row, const FollowedRow& now) const
    {
        std::uint32_t beyond = 0;
        for (int i = 0; i < lane_count && row.contact.v[i] != none; ++i)
        {
            const float margin = m_scene.speculation + relative_motion(m_state, m_state.contacts[row.contact.v[i]]);
            if (!(margin + now.way.v[i] < surely * m_scene.kept[row.contact.v[i]].margin))
                beyond |= 1u << i;
        }
        return beyond;
    }

    // Found anew, or followed, by itself.
    bool look_at(WideRow& row, int i)
    {
        const std::int32_t index = row.contact.v[i];
        m_scratch.is_looked_at[as_index(index)] = 1;
        const Contact& contact = m_state.contacts[index];
        if (update_contact(m_ctx, index) != News::Nothing || contact.manifold.count != row.count)
            return false;
        row.untold &= ~(1u << i);
        row.edge_of_b &= ~(1u << i);
        Link link;
        link.contact = index;
        link.a = row.a.v[i];
        link.b = row.b.v[i];
        fill_lane(m_ctx, link, row, i);
        note_if_loaded(row, i, least_separation(contact.manifold));
        return true;
    }

    // What is not borne may fly.
    void note_borne(const WideRow& row, int i) const
    {
        for (const std::int32_t s : {row.a.v[i], row.b.v[i]})
            std::atomic_ref(m_scratch.borne[as_index(s)]).store(1, std::memory_order_relaxed);
    }

    void note_if_loaded(const WideRow& row, int i, float separation) const
    {
        if (is_loaded(m_ctx, m_state.contacts[row.contact.v[i]], separation))
            note_borne(row, i);
    }

    const StepContext& m_ctx;
    SceneState& m_state;
    Scratch& m_scratch;
    FollowedScene m_scene;
    const WideKernels& m_kernels = wide_kernels();
};

bool keep_their_masses(const StepContext& ctx)
{
    const Scratch& scratch = ctx.scratch;
    std::atomic<bool> same{true};
    for_each_in_parts(ctx.scene.def.tasks, scratch.state_bodies.size(), states_per_task,
                      [&](std::size_t s)
                      {
                          const std::int32_t body = scratch.state_bodies[s];
                          if (body == none)
                              return;
                          const BodySim& sim = ctx.state.sims[as_index(body)];
                          const StateConstants& c = scratch.constants[s];
                          if (sim.inverse_mass != c.inverse_mass || sim.inverse_inertia != c.inverse_inertia)
                              same.store(false, std::memory_order_relaxed);
                      });
    return same;
}

bool are_in_place(const StepContext& ctx)
{
    const KeptUnits& kept = ctx.scratch.kept_units;
    return kept.rows_apart && kept.stamp == ctx.state.rows_stamp && !ctx.state.graph_dirty && ctx.scene.law_count == 0 &&
           ctx.state.joints.count() == 0 && ctx.state.awake_contacts == kept.contacts && bodies_stay(ctx) &&
           keep_their_masses(ctx);
}

// What has no lane must go on needing none.
bool look_at_loose(const StepContext& ctx, std::int32_t index)
{
    ctx.scratch.is_looked_at[as_index(index)] = 1;
    Contact& contact = ctx.state.contacts[index];
    const bool was_solved = is_solved(contact); // or would be, if what it touches moved
    if (update_contact(ctx, index) != News::Nothing || is_solved(contact) != was_solved)
        return false;
    if (!was_solved)
        forget_impulses(contact);
    return true;
}

bool loose_stay(const StepContext& ctx)
{
    const std::vector<std::int32_t>& loose = ctx.scratch.kept_units.loose;
    std::atomic<bool> stay{true};
    for_each_in_parts(ctx.scene.def.tasks, loose.size(), contacts_per_task,
                      [&](std::size_t i)
                      {
                          if (stay.load(std::memory_order_relaxed) && !look_at_loose(ctx, loose[i]))
                              stay.store(false, std::memory_order_relaxed);
                      });
    return stay;
}

// Those of a large unit by the threads that solve them, of small ones a few units to a task.
bool rows_stay(const StepContext& ctx)
{
    const std::vector<Unit>& units = ctx.scratch.units;
    std::atomic<bool> stay{true};
    const auto follow = [&](const Unit& unit, int first, int last)
    {
        RowFollower follower(ctx);
        for (int g = first; g < last && stay.load(std::memory_order_relaxed); ++g)
        {
            if (!follower.follow(ctx.scratch.wide_rows[as_index(unit.wide_store + g)]))
                stay.store(false, std::memory_order_relaxed);
        }
    };
    for (const Unit& unit : units)
    {
        if (is_large(unit))
            Crew::run(ctx.scene.def.tasks, [&](Crew& crew)
                      { contact_bins(ctx.scratch, unit).all(crew, [&](int first, int last) { follow(unit, first, last); }); });
    }
    for_each_in_parts(ctx.scene.def.tasks, units.size(), units_per_task,
                      [&](std::size_t u)
                      {
                          if (!is_large(units[u]))
                              follow(units[u], 0, units[u].wide_count);
                      });
    return stay;
}

bool all_are_borne(const StepContext& ctx)
{
    const Scratch& scratch = ctx.scratch;
    for (std::size_t s = 0; s < scratch.state_bodies.size(); ++s)
    {
        if (scratch.state_bodies[s] != none && scratch.borne[s] == 0)
            return false;
    }
    return true;
}

// Of two the one that does not give way is static: what is kinematic or asleep has more to say, and so has what lets pass.
bool leans_on_statics(const SceneState& state, const Link& l)
{
    const Contact& contact = state.contacts[l.contact];
    const auto is_plain = [&](std::int32_t place, std::int32_t body)
    { return place >= 0 || state.bodies[body].type == BodyType::Static; };
    return (contact.flags & contact_flag::one_way) == 0 && is_plain(l.a, contact.body_a) && is_plain(l.b, contact.body_b);
}

} // namespace

bool follow_rows(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    KeptUnits& kept = scratch.kept_units;
    kept.rows_stay = false;
    scratch.is_looked_at.clear();
    if (!are_in_place(ctx))
        return false;
    scratch.borne.assign(scratch.state_bodies.size(), 0);
    scratch.is_looked_at.assign(static_cast<std::size_t>(ctx.state.contacts.capacity()), 0);
    kept.rows_stay = loose_stay(ctx) && rows_stay(ctx) && (!ctx.scene.def.continuous || all_are_borne(ctx));
    if (kept.rows_stay)
        scratch.is_looked_at.clear();
    return kept.rows_stay;
}

void keep_rows(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    KeptUnits& kept = scratch.kept_units;
    kept.rows_apart = ctx.state.joints.count() == 0 && !scratch.has_kinematic && !scratch.units.empty() &&
                      std::all_of(scratch.links.begin(), scratch.links.end(),
                                  [&](const Link& l) { return !l.solved || (l.plain && leans_on_statics(ctx.state, l)); });
    if (!kept.rows_apart)
        return;
    kept.contacts = ctx.state.awake_contacts;
    kept.touching = ctx.report.touching;
    std::vector<std::int32_t>& has_lane = scratch.order;
    has_lane.assign(static_cast<std::size_t>(ctx.state.contacts.capacity()), 0);
    for (const Link& l : scratch.solved_links)
        has_lane[as_index(l.contact)] = 1;
    kept.loose.clear();
    std::copy_if(kept.contacts.begin(), kept.contacts.end(), std::back_inserter(kept.loose),
                 [&](std::int32_t contact) { return has_lane[as_index(contact)] == 0; });
}

} // namespace carom::internal
