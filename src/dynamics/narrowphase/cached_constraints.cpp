// A wide contact constraint holds all data of its contacts. In a crowd at rest, the same contacts, with the same number of points, stay in the same lanes from
// step to step. Then poses of bodies determine the rest. Bodies and contacts are compared with those of the last step; the lane mark of a contact
// (SceneState::lane_marks) tells that nothing else has changed it. A contact whose manifold cannot be followed is updated by itself, and its lane is refilled.

#include "dynamics/narrowphase/cached_constraints.h"

#include "core/index.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/islands/layout/cached_graph.h"
#include "dynamics/narrowphase/constraint_refresh.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/narrowphase/manifold_cache.h"
#include "dynamics/solver/contact/partitions.h"
#include "dynamics/solver/contact/prepare_wide.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/scene_data.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

namespace carom::internal {

namespace {

constexpr std::size_t islands_per_task = 4;

bool are_in_place(const StepContext& ctx)
{
    const CachedConstraints& cached = ctx.scratch.cached_constraints;
    return cached.are_valid && !ctx.state.graph_dirty && ctx.scene.law_count == 0 && ctx.state.joints.count() == 0 &&
           ctx.state.awake_contacts == cached.contacts && bodies_are_unchanged(ctx);
}

// A contact without a lane must still need none.
bool look_at_loose(const StepContext& ctx, std::int32_t index)
{
    ctx.scratch.narrow.is_looked_at[as_index(index)] = 1;
    Contact& contact = ctx.state.contacts[index];
    const bool was_solved = is_solved(contact); // or would be, if the other body moved
    if (update_contact(ctx, index) != TouchChange::Nothing || is_solved(contact) != was_solved)
        return false;
    if (!was_solved)
        forget_impulses(ctx.state, index);
    return true;
}

bool loose_contacts_are_unchanged(const StepContext& ctx)
{
    const std::vector<std::int32_t>& loose = ctx.scratch.cached_constraints.loose;
    std::atomic<bool> stay{true};
    for_each_in_chunks(ctx.scene.def.tasks, loose.size(), contacts_per_task,
                       [&](std::size_t i)
                       {
                           if (stay.load(std::memory_order_relaxed) && !look_at_loose(ctx, loose[i]))
                               stay.store(false, std::memory_order_relaxed);
                       });
    return stay;
}

bool are_marked(const SceneState& state, const WideContactNotes& notes)
{
    return std::ranges::all_of(notes.contact.v, [&](std::int32_t contact)
                               { return contact == none || state.lane_marks[as_index(contact)] == LaneMark::InLane; });
}

// Constraints of a large island are refreshed by the threads that solve it; small islands are processed a few to a task.
bool constraints_are_unchanged(const StepContext& ctx)
{
    const std::vector<Island>& islands = ctx.scratch.solver.islands;
    std::atomic<bool> stay{true};
    const auto follow = [&](const Island& island, int first, int last)
    {
        ConstraintRefresh follower(ctx);
        WideContact* const constraints = ctx.scratch.solver.wide_contacts.data() + island.wide_store;
        WideContactNotes* const all_notes = ctx.scratch.solver.wide_notes.data() + island.wide_store;
        const bool asks_ahead = !is_shared(island); // much of a large island is still in the thread's cache
        for (int g = first; g < last && stay.load(std::memory_order_relaxed); ++g)
        {
            WideContactNotes& notes = all_notes[g];
            if (asks_ahead)
            { // prefetching past the end does no harm
                prefetch(constraints[g + 2]);
                prefetch(all_notes[g + 2]);
            }
            const RefreshChanges changes = are_marked(ctx.state, notes) ? follower.follow(as_index(island.wide_store + g))
                                                                        : RefreshChanges{.gone = filled_lanes(notes)};
            if ((changes.gone | changes.told) != 0)
                stay.store(false, std::memory_order_relaxed);
        }
    };
    for (const Island& island : islands)
    {
        if (is_shared(island))
            WorkerTeam::run(
                ctx.scene.def.tasks, [&](WorkerTeam& team)
                { contact_buckets(ctx.scratch, island).all(team, [&](int first, int last) { follow(island, first, last); }); });
    }
    for_each_in_chunks(ctx.scene.def.tasks, islands.size(), islands_per_task,
                       [&](std::size_t u)
                       {
                           if (!is_shared(islands[u]))
                               follow(islands[u], 0, islands[u].wide_count);
                       });
    return stay;
}

bool all_are_borne(const StepContext& ctx)
{
    const Scratch& scratch = ctx.scratch;
    for (std::size_t s = 0; s < scratch.solver.state_bodies.size(); ++s)
    {
        if (scratch.solver.state_bodies[s] != none && scratch.narrow.borne[s] == 0)
            return false;
    }
    return true;
}

// A body without finite mass must be static: kinematic and sleeping bodies need more checks, and so do one-way contacts.
bool leans_on_statics(const SceneState& state, const ContactEdge& l)
{
    const Contact& contact = state.contacts[l.contact];
    const auto is_plain = [&](std::int32_t place, std::int32_t body)
    { return place >= 0 || state.bodies[body].type == BodyType::Static; };
    return (contact.flags & contact_flag::one_way) == 0 && is_plain(l.a, contact.body_a) && is_plain(l.b, contact.body_b);
}

} // namespace

bool refresh_cached_constraints(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    CachedConstraints& cached = scratch.cached_constraints;
    scratch.reuse = Reuse::Nothing;
    const std::uint64_t unchanged_for = std::exchange(cached.unchanged_for, 0);
    scratch.narrow.is_looked_at.clear();
    const bool are_of_this_state = ctx.state.lanes_stamp != 0 && cached.stamp == ctx.state.lanes_stamp;
    ctx.state.lanes_stamp = 0; // invalid until the constraints have been solved
    scratch.cached_graph.is_valid &= are_of_this_state;
    if (!are_of_this_state || !cached.are_valid)
        return false;
    scratch.narrow.borne.assign(scratch.solver.state_bodies.size(), 0);
    scratch.narrow.is_looked_at.assign(static_cast<std::size_t>(ctx.state.contacts.capacity()), 0);
    const bool are_unchanged = are_in_place(ctx) && loose_contacts_are_unchanged(ctx) && constraints_are_unchanged(ctx) &&
                               (!ctx.scene.def.continuous || all_are_borne(ctx));
    if (!are_unchanged)
        return false;
    scratch.reuse = Reuse::Constraints;
    scratch.narrow.is_looked_at.clear();
    cached.unchanged_for = unchanged_for + 1;
    return true;
}

void cache_constraints(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    CachedConstraints& cached = scratch.cached_constraints;
    const auto may_stay = [&](const ContactEdge& l) { return !l.has(edge_flag::solved) || leans_on_statics(ctx.state, l); };
    cached.are_valid = ctx.state.joints.count() == 0 && !scratch.graph.has_kinematic && !scratch.solver.islands.empty() &&
                       std::ranges::all_of(scratch.graph.edges, may_stay);
    if (!cached.are_valid)
        return;
    cached.contacts = ctx.state.awake_contacts;
    cached.touching = ctx.report.touching;
    std::vector<std::int32_t>& has_lane = scratch.order;
    has_lane.assign(static_cast<std::size_t>(ctx.state.contacts.capacity()), 0);
    for (const SolvedEdge& l : scratch.layout.solved_edges)
        has_lane[as_index(l.contact)] = 1;
    cached.loose.clear();
    std::copy_if(cached.contacts.begin(), cached.contacts.end(), std::back_inserter(cached.loose),
                 [&](std::int32_t contact) { return has_lane[as_index(contact)] == 0; });
}

} // namespace carom::internal
