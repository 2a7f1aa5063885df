// Meetings in flight beyond the paths with which pairs were found: a body deflected by an impact may go anywhere within its reach.

#include "dynamics/islands/flight_meetings.h"

#include "core/grow.h"
#include "core/task_pool.h"
#include "dynamics/islands/tallies.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/scene_data.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>
#include <vector>

namespace carom::internal {

namespace {

constexpr std::size_t reaches_per_task = 4; // blocks of eight

class FlightMeetings
{
public:
    explicit FlightMeetings(StepContext& context) : ctx(context), state(context.state), scratch(context.scratch) {}

    // A ball that will hit something may then go anywhere within its reach. Any other flier there must be in the same island, or the two would meet at
    // different times. True where islands have been merged.
    bool join_deflected()
    {
        find_deflected();
        scratch.graph.may_be_struck = scratch.meetings.is_deflected;
        if (scratch.meetings.reaches.empty())
            return false;
        scratch.meetings.reach_tree.build(ctx.scene.def.tasks, scratch.meetings.reaches);
        using Meetings = std::vector<std::pair<std::int32_t, std::int32_t>>;
        const auto blocks = static_cast<std::size_t>(scratch.meetings.reach_tree.block_count());
        const std::span<Meetings> parts = find_in_chunks(
            ctx.scene.def.tasks, blocks, reaches_per_task, scratch.meetings.meetings_of_task,
            [&](std::size_t first, std::size_t last, Meetings& meetings) { find_meetings(first, last, meetings); });
        scratch.graph.sets.reset(scratch.graph.tallies.size());
        bool linked = false;
        for (const Meetings& some : parts)
        {
            for (const auto& [island, other] : some)
                linked |= scratch.graph.sets.link(island, other, false);
        }
        return linked;
    }

private:
    // Finds the fliers that may be deflected by something on their paths, the boxes that they may then reach, and the other items of the moving layer.
    void find_deflected()
    {
        scratch.meetings.is_deflected.assign(state.awake_bodies.size(), 0);
        find_fastest();
        const std::span<SomeReaches> parts =
            find_in_chunks(ctx.scene.def.tasks, scratch.graph.flying.size(), fliers_per_task, scratch.meetings.reaches_of_task,
                           [&](std::size_t first, std::size_t last, SomeReaches& some) { find_reaches(first, last, some); });
        scratch.meetings.reaches.clear();
        std::vector<std::int32_t>& shapes = scratch.order;
        shapes.clear();
        for (const SomeReaches& some : parts)
        {
            append_all(scratch.meetings.reaches, some.reaches);
            append_all(shapes, some.shapes);
        }
        if (!shapes.empty())
            state.broad_phase.choose_all_but(Layer::Moving, shapes, scratch.meetings.keeps_its_path);
    }

    // A struck body may leave as fast as the striking one arrives. So each island notes the longest displacement of its fliers that may still meet something.
    void find_fastest()
    {
        for (IslandTally& t : scratch.graph.tallies)
            t.longest_path = 0;
        set_size(scratch.meetings.may_meet, state.awake_bodies.size());
        for_each_in_chunks(ctx.scene.def.tasks, scratch.graph.flying.size(), fliers_per_task,
                           [&](std::size_t i)
                           {
                               const std::int32_t place = scratch.graph.flying[i];
                               if (!flies_far(place))
                                   return;
                               const bool meets = may_meet(place);
                               scratch.meetings.may_meet[static_cast<std::size_t>(place)] = meets ? 1 : 0;
                               if (!meets)
                                   return;
                               const float displacement = scratch.broad.motion[static_cast<std::size_t>(place)];
                               const std::atomic_ref longest(tally_of(scratch, place).longest_path);
                               float before = longest.load(std::memory_order_relaxed);
                               while (before < displacement &&
                                      !longest.compare_exchange_weak(before, displacement, std::memory_order_relaxed))
                               {
                               }
                           });
    }

    void find_reaches(std::size_t first, std::size_t last, SomeReaches& some) const
    {
        some.reaches.clear();
        some.shapes.clear();
        for (std::size_t i = first; i < last; ++i)
        {
            const std::int32_t item = scratch.graph.flying[i];
            const auto place = static_cast<std::size_t>(item);
            const float displacement =
                scratch.graph.tallies[static_cast<std::size_t>(scratch.graph.island_of[place])].longest_path;
            if (displacement == 0 || !(flies_far(item) ? scratch.meetings.may_meet[place] != 0 : may_meet(item)))
                continue;
            scratch.meetings.is_deflected[place] = 1;
            const int body = body_at(item);
            const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
            const double r = static_cast<double>(displacement) + static_cast<double>(sim.extent);
            const Position c = sim.center;
            some.reaches.push_back({round_outwards(c.x - r, c.y - r, c.x + r, c.y + r), item});
            for_each_leaf(state, body, [&](int shape) { some.shapes.push_back(shape); });
        }
    }

    [[nodiscard]] bool flies_far(std::int32_t place) const
    {
        return scratch.broad.motion[static_cast<std::size_t>(place)] > ctx.scene.tolerances.speculation;
    }

    [[nodiscard]] bool may_meet(std::int32_t place) const
    {
        for (const int index : contacts_of(state, body_at(place)))
        {
            if (is_solved(state.contacts[index]) && !stays_apart(ctx, state.contacts[index]))
                return true;
        }
        return false;
    }

    // Finds islands that meet, and notes which other bodies may be struck.
    void find_meetings(std::size_t first, std::size_t last, std::vector<std::pair<std::int32_t, std::int32_t>>& meetings) const
    {
        const BoxTree& tree = scratch.meetings.reach_tree;
        meetings.clear();
        const auto note = [&](std::int32_t place, std::int32_t other)
        {
            const std::pair islands(scratch.graph.island_of[static_cast<std::size_t>(place)],
                                    scratch.graph.island_of[static_cast<std::size_t>(other)]);
            const bool is_known = !meetings.empty() && meetings.back() == islands;
            if (islands.second != none && islands.first != islands.second && !is_known) // kinematic bodies have no island
                meetings.push_back(islands);
        };
        for (int k = static_cast<int>(first); k < static_cast<int>(last); ++k)
        {
            const unsigned lanes = (1u << std::min(tree.leaf_count() - k * BoxTree::arity, BoxTree::arity)) - 1;
            state.broad_phase.for_each_overlap(
                tree, k, lanes, Layer::Moving, scratch.meetings.keeps_its_path,
                [&](std::int32_t place, int shape)
                {
                    const std::size_t other = place_of_shape(shape);
                    std::atomic_ref(scratch.graph.may_be_struck[other]).store(1, std::memory_order_relaxed);
                    if (scratch.meetings.is_deflected[other] == 0) // an item that no tree holds yet is not chosen
                        note(place, static_cast<std::int32_t>(other));
                });
            // If both are deflected, the first finds the second.
            tree.for_each_overlap(
                k, lanes, tree, [&](int other) { return other < k ? 0 : BoxTree::all_lanes; },
                [&](int own, int other)
                {
                    if (own < other)
                        note(tree.item(own), tree.item(other));
                });
        }
    }

    // Index in awake_bodies.
    [[nodiscard]] std::size_t place_of_shape(int shape) const
    {
        return static_cast<std::size_t>(state.bodies[state.shapes[shape].body].awake_index);
    }

    [[nodiscard]] int body_at(std::int32_t place) const { return state.awake_bodies[static_cast<std::size_t>(place)]; }

    StepContext& ctx;
    SceneState& state;
    Scratch& scratch;
};

} // namespace

bool join_deflected(StepContext& ctx) { return FlightMeetings(ctx).join_deflected(); }

} // namespace carom::internal
