// Islands are sets of bodies that touch, are joined or may come to touch in this step, connected through dynamic bodies, and merged further where flight paths
// may meet. An island's policy depends on its content alone, never on threads or the order of other islands.

#include "dynamics/islands/island_graph.h"

#include "core/grow.h"
#include "core/task_pool.h"
#include "dynamics/forces/force_laws.h"
#include "dynamics/islands/flight_meetings.h"
#include "dynamics/islands/joint_edges.h"
#include "dynamics/islands/layout/sort_by_island.h"
#include "dynamics/islands/subdivisions.h"
#include "dynamics/islands/tallies.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

constexpr int enough_bodies = 256; // bodies at which an island with soft joints, or of isolated bodies, is full
constexpr int most_sets = 4;       // sets that are joined in parallel

// --- what is solved in this step --------------------------------------------------------------------------------------------------

bool gets_constraints(const SceneState& state, const Contact& contact)
{
    return is_solved(contact) && (is_moving_dynamic(state, contact.body_a) || is_moving_dynamic(state, contact.body_b));
}

// --- the graph --------------------------------------------------------------------------------------------------------------------

class IslandGraph
{
public:
    explicit IslandGraph(StepContext& context) : ctx(context), state(context.state), scratch(context.scratch) {}

    // With enough edges, several threads join sets of their own, because edges are scattered over all bodies. The other sets are then merged into the first.
    void join_islands()
    {
        const int worth = 1 + static_cast<int>((scratch.graph.edges.size() + scratch.graph.joint_edges.size()) / edges_per_task);
        const int parts = std::clamp(ctx.scene.def.tasks.worker_count, 1, std::min(worth, most_sets));
        if (scratch.graph.more_sets.size() + 1 < static_cast<std::size_t>(parts))
            scratch.graph.more_sets.resize(static_cast<std::size_t>(parts) - 1);
        const auto sets_of = [&](int part) -> UnionFind&
        { return part == 0 ? scratch.graph.sets : scratch.graph.more_sets[static_cast<std::size_t>(part) - 1]; };
        run_tasks(ctx.scene.def.tasks, parts, [&](int part) { gather_part(part, parts, sets_of(part)); });
        for (int part = 1; part < parts; ++part)
            scratch.graph.sets.join_all(sets_of(part));
    }

    void gather_part(int part, int parts, UnionFind& sets)
    {
        const auto over_both_ends = [&](const auto& edges, const auto& visit)
        {
            const auto bound = [&](int p)
            { return edges.size() * static_cast<std::size_t>(p) / static_cast<std::size_t>(parts); };
            for (const auto& l : std::span(edges).subspan(bound(part), bound(part + 1) - bound(part)))
                visit(l.a, l.b); // a body that is not dynamic has a negative index
        };
        const auto guess = [&](std::int32_t a, std::int32_t b) { sets.guess(a, b); };
        const auto edge = [&](std::int32_t a, std::int32_t b) { sets.link(a, b, false); };
        sets.reset(state.awake_bodies.size());
        over_both_ends(scratch.graph.edges, guess);
        over_both_ends(scratch.graph.joint_edges, guess);
        sets.flatten();
        over_both_ends(scratch.graph.edges, edge);
        over_both_ends(scratch.graph.joint_edges, edge);
        sets.flatten();
    }

    // In a crowd only fast movers and bodies that bounce fly: contacts of the others are speculative.
    void keep_crowds_from_flight()
    {
        for (const std::int32_t place : scratch.graph.flying)
        {
            ++tally_of(scratch, place).unloaded;
            tally_of(scratch, place).bouncing += scratch.graph.may_bounce[static_cast<std::size_t>(place)];
        }
        for_each_in_chunks(ctx.scene.def.tasks, scratch.graph.flying.size(), fliers_per_task,
                           [&](std::size_t i)
                           {
                               const std::int32_t place = scratch.graph.flying[i];
                               std::int32_t& flight = scratch.graph.flight_mode[static_cast<std::size_t>(place)];
                               if (limits_flight_to_fast_movers(tally_of(scratch, place).unloaded) && !bounces(place) &&
                                   !is_fast_mover(body_at(place)))
                                   scratch.graph.could_fly[static_cast<std::size_t>(place)] = std::exchange(flight, solver_owned);
                           });
        std::erase_if(scratch.graph.flying, [&](std::int32_t place)
                      { return scratch.graph.flight_mode[static_cast<std::size_t>(place)] == solver_owned; });
        for (const std::int32_t place : scratch.graph.flying)
            ++tally_of(scratch, place).fliers;
    }

    // A crowd flies as a whole if most of it bounces: often the whole step at once.
    [[nodiscard]] bool bounces(std::int32_t place) const
    {
        const IslandTally& t = tally_of(scratch, place);
        if (std::ranges::binary_search(state.rattling, body_at(place), {}, &RattlingBody::body))
            return false;
        return scratch.graph.may_bounce[static_cast<std::size_t>(place)] != 0 || 2 * t.bouncing > t.unloaded;
    }

    // True if the body moves by more than half its size in a sub-step, also relative to its neighbors.
    [[nodiscard]] bool is_fast_mover(int body) const
    {
        const float limit = 0.5f * state.sims[static_cast<std::size_t>(body)].size / ctx.h;
        const Vec2 v = state.sims[static_cast<std::size_t>(body)].velocity;
        if (length(v) <= limit)
            return false;
        for (const int index : contacts_of(state, body))
        {
            const Contact& contact = state.contacts[index];
            const int other = other_body(contact, body);
            if (gets_constraints(state, contact) && state.bodies[other].type == BodyType::Dynamic &&
                length(v - state.sims[static_cast<std::size_t>(other)].velocity) <= limit)
                return false;
        }
        return true;
    }

    // The way in which joints are solved depends on the number of contacts and of those that bear a load.
    void count_contacts()
    {
        if (scratch.graph.joint_edges.empty())
            return;
        for (const ContactEdge& l : scratch.graph.edges)
        {
            if (!l.has(edge_flag::solved))
                continue;
            IslandTally& t = tally(scratch, island_of_edge(scratch, l));
            ++t.contacts;
            t.bearing += l.has(edge_flag::bears) ? 1 : 0;
        }
    }

    [[nodiscard]] int body_at(std::int32_t place) const { return state.awake_bodies[static_cast<std::size_t>(place)]; }
    // Islands with soft joints are solved several at a time: lanes are fuller, and the islands do not affect each other. Isolated bodies are combined as well,
    // because they are many.
    void form_islands()
    {
        find_isolated();
        std::vector<std::int32_t>& island_of_group = scratch.order;
        island_of_group.clear();
        scratch.solver.islands.clear();
        Batch soft;
        Batch isolated;
        for (const IslandTally& t : scratch.graph.tallies)
        {
            const bool is_isolated = t.bodies == 1 && scratch.graph.is_isolated[static_cast<std::size_t>(t.first)] != 0;
            const IslandPolicy policy = choose_policy(t, is_isolated, ctx.dt, ctx.scene.def.most_passes, ctx.scene.forced_policy);
            Batch* batch = policy.soft_joints ? &soft : policy.free_fall ? &isolated : nullptr;
            if (batch == nullptr || batch->island == none || batch->bodies >= enough_bodies)
            {
                append(scratch.solver.islands, {});
                Island& island = scratch.solver.islands.back();
                island.policy = policy;
                if (batch != nullptr)
                    *batch = {static_cast<std::int32_t>(scratch.solver.islands.size()) - 1, 0};
            }
            if (batch != nullptr)
                batch->bodies += t.bodies;
            island_of_group.push_back(batch != nullptr ? batch->island
                                                       : static_cast<std::int32_t>(scratch.solver.islands.size()) - 1);
        }
        ctx.report.islands = static_cast<int>(scratch.graph.tallies.size());
        if (scratch.solver.islands.size() == scratch.graph.tallies.size())
            return;
        for_each_in_chunks(ctx.scene.def.tasks, scratch.graph.island_of.size(), bodies_per_task,
                           [&](std::size_t place)
                           {
                               std::int32_t& u = scratch.graph.island_of[place];
                               u = u == none ? none : island_of_group[static_cast<std::size_t>(u)];
                           });
    }

    struct Batch
    {
        std::int32_t island = none;
        int bodies = 0;
    };

    // Isolated bodies among the fliers.
    void find_isolated()
    {
        set_size(scratch.graph.is_isolated, state.awake_bodies.size());
        for_each_in_chunks(ctx.scene.def.tasks, scratch.graph.flying.size(), fliers_per_task,
                           [&](std::size_t i)
                           {
                               const std::int32_t place = scratch.graph.flying[i];
                               const bool isolated = tally_of(scratch, place).bodies == 1 && is_isolated(place);
                               scratch.graph.is_isolated[static_cast<std::size_t>(place)] = isolated ? 1 : 0;
                           });
    }

    [[nodiscard]] bool is_isolated(std::int32_t place) const
    {
        const int body = body_at(place);
        const BodyRecord& record = state.bodies[body];
        return scratch.graph.flight_mode[static_cast<std::size_t>(place)] == free_flight && record.first_joint == none &&
               meets_nothing(body) && is_free_of_loads(body) && !ctx.scene.def.record_substeps;
    }

    [[nodiscard]] bool is_free_of_loads(int body) const
    {
        const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
        return sim.force == Vec2{} && sim.torque == 0 && force_law_of(ctx, body) == nullptr;
    }

    // Pairs without points do not meet on their initial paths. A trigger needs the path of the body.
    [[nodiscard]] bool meets_nothing(int body) const
    {
        for (const int index : contacts_of(state, body))
        {
            const Contact& contact = state.contacts[index];
            if (contact.manifold.count > 0 || !means_apart(contact) || (contact.flags & contact_flag::trigger) != 0)
                return false;
        }
        return true;
    }

    // Numbers the islands in the order of their first bodies. Every dynamic body gets its island and is counted there. Branch-free in whether a body is first:
    // a branch would be mispredicted.
    void number_islands()
    {
        const std::size_t n = state.awake_bodies.size();
        std::vector<std::int32_t>& firsts = scratch.order;
        set_size(firsts, n + 1);
        set_size(scratch.graph.island_of, n);
        std::int32_t count = 0;
        for (std::size_t i = 0; i < n; ++i)
        {
            const auto before = static_cast<std::size_t>(scratch.graph.sets.before(i));
            const bool moves = !scratch.graph.has_kinematic || state.bodies[state.awake_bodies[i]].type == BodyType::Dynamic;
            const bool is_first = before == i;
            firsts[static_cast<std::size_t>(count)] = static_cast<std::int32_t>(i);
            scratch.graph.island_of[i] = is_first ? (moves ? count : none) : scratch.graph.island_of[before];
            count += is_first && moves ? 1 : 0;
        }
        scratch.graph.tallies.clear();
        set_size(scratch.graph.tallies, static_cast<std::size_t>(count));
        for (std::int32_t island = 0; island < count; ++island)
            tally(scratch, island).first = firsts[static_cast<std::size_t>(island)];
        for_each_run(
            0, n, [&](std::size_t i) { return scratch.graph.island_of[i]; },
            [&](const IslandRun& run) { tally(scratch, run.island).bodies += run.count; });
    }

    // After islands have been merged: the remaining ones keep their order.
    void renumber_islands()
    {
        std::vector<std::int32_t>& numbers = scratch.order;
        set_size(numbers, scratch.graph.tallies.size());
        std::int32_t count = 0;
        for (std::size_t u = 0; u < scratch.graph.tallies.size(); ++u)
        {
            const IslandTally old{.first = scratch.graph.tallies[u].first, .bodies = scratch.graph.tallies[u].bodies};
            const auto before = static_cast<std::size_t>(scratch.graph.sets.before(u));
            numbers[u] = before == u ? count++ : numbers[before];
            if (before == u)
                tally(scratch, numbers[u]) = old;
            else
                tally(scratch, numbers[u]).bodies += old.bodies;
        }
        scratch.graph.tallies.resize(static_cast<std::size_t>(count));
        for_each_in_chunks(ctx.scene.def.tasks, scratch.graph.island_of.size(), bodies_per_task,
                           [&](std::size_t place)
                           {
                               std::int32_t& island = scratch.graph.island_of[place]; // kinematic bodies have no island
                               island = island == none ? none : numbers[static_cast<std::size_t>(island)];
                           });
    }

    // A body in flight meets others at its own time; a constraint would stop it early.
    [[nodiscard]] bool gets_constraint(const ContactEdge& l) const
    {
        return l.has(edge_flag::solved) && !in_flight(l.a) && !in_flight(l.b);
    }
    [[nodiscard]] bool in_flight(std::int32_t place) const
    {
        return place >= 0 && scratch.graph.flight_mode[static_cast<std::size_t>(place)] != solver_owned;
    }

    // Runs on all threads. The rest of the stage uses only these islands of edges.
    void find_islands_of_edges()
    {
        set_size(scratch.graph.island_of_edge, scratch.graph.edges.size());
        using Some = std::vector<KinematicMeeting>;
        const std::span<Some> parts = find_in_chunks(
            ctx.scene.def.tasks, scratch.graph.edges.size(), edges_per_task, scratch.graph.meetings_with_kinematic_of_task,
            [&](std::size_t first, std::size_t last, Some& meetings)
            {
                meetings.clear();
                for (std::size_t i = first; i < last; ++i)
                {
                    const ContactEdge& l = scratch.graph.edges[i];
                    const std::int32_t island = scratch.graph.island_of_edge[i] = island_of_constraint(l);
                    const std::int32_t kinematic = std::min(l.a, l.b); // if either body is kinematic
                    if (kinematic < none && island != none)
                        meetings.push_back({island, static_cast<std::int32_t>(i), -2 - kinematic});
                }
            });
        scratch.graph.meetings_with_kinematic.clear();
        for (const Some& some : parts)
            append_all(scratch.graph.meetings_with_kinematic, some);
        std::ranges::sort(scratch.graph.meetings_with_kinematic, {},
                          [](const KinematicMeeting& m) { return std::pair(m.island, m.edge); });
    }

    void sort_joints()
    {
        sort_by_island(
            ctx.scene.def.tasks, scratch, scratch.graph.joint_edges.size(), scratch.graph.solved_joints, joints_per_task,
            [&](std::size_t i) { return scratch.graph.joint_edges[i]; },
            [&](std::size_t i) { return island_of_edge(scratch, scratch.graph.joint_edges[i]); },
            [](Island& island, int first, int count)
            {
                island.first_joint_edge = first;
                island.joint_edge_count = count;
            });
    }

    // By island, and within an island by plane cell: threads that work on parts of an island seldom meet in one body.
    void sort_bodies()
    {
        sort_by_island(
            ctx.scene.def.tasks, scratch, scratch.graph.in_plane.size(), scratch.graph.solved_bodies, bodies_per_task,
            [&](std::size_t i) { return scratch.graph.in_plane[i]; },
            [&](std::size_t i) { return scratch.graph.island_of[static_cast<std::size_t>(scratch.graph.in_plane[i])]; },
            [](Island& island, int first, int count)
            {
                island.first_body = first;
                island.dynamic_count = count;
            });
    }

    // Counting sort of awake indices by plane cell.
    void sort_by_cell()
    {
        std::vector<std::int32_t>& places = scratch.graph.in_plane;
        const auto cell_of = [&](std::int32_t body) { return static_cast<std::size_t>(state.bodies[body].plane_cell); };
        std::int32_t starts[plane_cells + 1] = {};
        for (const std::int32_t body : state.awake_bodies)
            ++starts[cell_of(body) + 1];
        scratch.graph.fullest_cell = static_cast<std::size_t>(*std::ranges::max_element(starts));
        for (int cell = 0; cell < plane_cells; ++cell)
            starts[cell + 1] += starts[cell];
        set_size(places, state.awake_bodies.size());
        for (std::size_t i = 0; i < places.size(); ++i)
            places[static_cast<std::size_t>(starts[cell_of(state.awake_bodies[i])]++)] = static_cast<std::int32_t>(i);
    }

private:
    // Island of an edge; none where it gets no constraint.
    [[nodiscard]] std::int32_t island_of_constraint(const ContactEdge& l) const
    {
        if (gets_constraint(l))
            return island_of_edge(scratch, l);
        if (l.has(edge_flag::solved))
            leave_constraint(state, l.contact);
        return none;
    }

    StepContext& ctx;
    SceneState& state;
    Scratch& scratch;
};

} // namespace

void build_island_graph(StepContext& ctx)
{
    IslandGraph graph(ctx);
    graph.join_islands();
    run_both(ctx.scene.def.tasks, [&] { graph.number_islands(); }, [&] { graph.sort_by_cell(); });
    graph.keep_crowds_from_flight();
    while (join_deflected(ctx))
    {
        graph.renumber_islands();
        graph.keep_crowds_from_flight();
    }
    graph.count_contacts();
    find_subdivisions(ctx);
    graph.form_islands();
    graph.find_islands_of_edges();
    graph.sort_joints();
    graph.sort_bodies();
    ctx.state.graph_dirty = false;
}

} // namespace carom::internal
