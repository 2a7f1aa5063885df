// Constraints of an island are sorted by color. Those of a large island are wide constraints of eight lanes, sorted by partition first, see partitions.h. A
// contact that had a constraint in the last step keeps its color. Any other takes the least color that neither moving body has yet, in the order of the edges.
// Each task counts its own edges; the counts of all tasks then give the slots.

#include "dynamics/islands/layout/constraint_slots.h"

#include "core/grow.h"
#include "core/index.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/islands/layout/island_layout.h"
#include "dynamics/islands/layout/sort_by_island.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/state/coloring.h"
#include "dynamics/state/scene_data.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

constexpr std::size_t most_tasks = 64;        // per island: each counts all of its buckets
constexpr std::uint16_t no_partition = 65535; // for a state without finite mass

class ConstraintSlots
{
public:
    ConstraintSlots(StepContext& ctx, Island& island) : m_ctx(ctx), m_state(ctx.state), m_scratch(ctx.scratch), m_island(island)
    {}

    void find()
    {
        m_island.first_constraint = static_cast<std::int32_t>(m_scratch.layout.constraint_edges.size());
        m_island.first_wide = static_cast<std::int32_t>(m_scratch.layout.lane_edges.size()) / lane_count;
        m_island.first_core = static_cast<std::int32_t>(m_scratch.solver.cores.size());
        m_is_uniform = m_island.policy.wide_contacts && is_uniform(m_ctx, m_island);
        find_partitions();
        name_copies();
        const std::span<SlotsOfTask> tasks = count_edges();
        color_new_constraints(tasks);
        give_out_places(tasks);
        run_tasks(m_ctx.scene.def.tasks, static_cast<int>(tasks.size()),
                  [&](int t) { place(as_index(t) * edges_of_task(), tasks[as_index(t)]); });
        gather(tasks);
        m_island.wide_count = static_cast<std::int32_t>(m_scratch.layout.lane_edges.size()) / lane_count - m_island.first_wide;
        m_island.constraint_count =
            static_cast<std::int32_t>(m_scratch.layout.constraint_edges.size()) - m_island.first_constraint;
        m_island.core_count = static_cast<std::int32_t>(m_scratch.solver.cores.size()) - m_island.first_core;
    }

private:
    // --- partitions -------------------------------------------------------------------------------------------------------------------

    // A partition consists of whole plane cells. All have about the same work.
    void find_partitions()
    {
        if (m_island.partitions == 0)
            return;
        std::fill_n(m_scratch.solver.partition_of.begin() + m_island.first_state, m_island.state_count, no_partition);
        const std::vector<CellOfIsland>& cells = find_cells();
        std::int64_t all = 0;
        for (const CellOfIsland& cell : cells)
            all += cell.work;
        std::int64_t before = 0;
        auto to = m_scratch.solver.partition_of.begin() + m_island.first_state + 1;
        for (const CellOfIsland& cell : cells)
        {
            to = std::fill_n(to, cell.states, static_cast<std::uint16_t>((before + cell.work / 2) * m_island.partitions / all));
            before += cell.work;
        }
    }

    // Cells in the order of the states. They are found on all threads; cells that lie in two tasks are then merged.
    [[nodiscard]] const std::vector<CellOfIsland>& find_cells() const
    {
        using Some = std::vector<CellOfIsland>;
        const std::span<Some> tasks = find_in_chunks(
            m_ctx.scene.def.tasks, as_index(m_island.dynamic_count), bodies_per_task, m_scratch.layout.cells_of_task,
            [&](std::size_t first, std::size_t last, Some& cells)
            {
                cells.clear();
                for (std::size_t i = first; i < last; ++i)
                {
                    const int body = m_scratch.solver.state_bodies[as_index(m_island.first_state + 1) + i];
                    add_to_cells(cells, {m_state.bodies[body].plane_cell, 1, work_of(body)});
                }
            });
        for (const Some& cells : tasks.subspan(1))
        {
            for (const CellOfIsland& cell : cells)
                add_to_cells(tasks[0], cell);
        }
        return tasks[0];
    }

    static void add_to_cells(std::vector<CellOfIsland>& cells, const CellOfIsland& more)
    {
        if (cells.empty() || cells.back().cell != more.cell)
        {
            append(cells, more);
            return;
        }
        cells.back().states += more.states;
        cells.back().work += more.work;
    }

    // The body itself, and its constraints in the last step twice, because each belongs to two bodies. Huge islands have so many partitions that threads finish
    // together anyway.
    [[nodiscard]] std::int64_t work_of(int body) const
    {
        return exceeds_shared_cache(m_island.partitions) ? 1 : 1 + 2 * std::popcount(colors_of(m_state, body));
    }

    // Partition of the bodies that have finite mass. Boundary constraints between two partitions come after all partitions.
    [[nodiscard]] int partition_of(const SolvedEdge& l) const
    {
        if (m_island.partitions == 0)
            return 0;
        const std::uint16_t a = m_scratch.solver.partition_of[as_index(l.a)];
        const std::uint16_t b = m_scratch.solver.partition_of[as_index(l.b)];
        return a == b || b == no_partition ? a : a == no_partition ? b : m_island.partitions;
    }

    // --- states -----------------------------------------------------------------------------------------------------------------------

    // Each island has its own copies of kinematic bodies.
    void name_copies()
    {
        for (std::int32_t s = m_island.first_state + 1 + m_island.dynamic_count; s < m_island.first_state + m_island.state_count;
             ++s)
        {
            const int body = m_scratch.solver.state_bodies[as_index(s)];
            m_scratch.solver.state_of[as_index(m_state.bodies[body].awake_index)] = s;
        }
    }

    // State at an index as in ContactEdge.
    [[nodiscard]] std::int32_t state_at(std::int32_t place) const
    {
        return place == none ? m_island.first_state : m_scratch.solver.state_of[as_index(place >= 0 ? place : -2 - place)];
    }

    // --- colors and counts ------------------------------------------------------------------------------------------------------------

    [[nodiscard]] std::span<SolvedEdge> edges() const
    {
        return std::span(m_scratch.layout.solved_edges).subspan(as_index(m_island.first_edge), as_index(m_island.edge_count));
    }

    // A small island is one task.
    [[nodiscard]] std::size_t edges_of_task() const
    {
        return m_island.partitions > 0 ? std::max(edges_per_task, edges().size() / most_tasks)
                                       : std::max<std::size_t>(edges().size(), 1);
    }

    [[nodiscard]] std::span<SlotsOfTask> count_edges()
    {
        return find_in_chunks(
            m_ctx.scene.def.tasks, std::max<std::size_t>(edges().size(), 1), edges_of_task(), m_scratch.layout.slots_of_task,
            [&](std::size_t first, std::size_t last, SlotsOfTask& some)
            {
                some.lanes.resize(std::max(some.lanes.size(), as_index((m_island.partitions + 1) * buckets_to_a_partition)));
                some.uncolored.clear();
                some.cores.clear();
                some.colors = 0;
                some.has_features = false;
                for (std::size_t i = first; i < std::min(last, edges().size()); ++i)
                {
                    SolvedEdge& l = edges()[i];
                    const ContactEdge& edge =
                        m_scratch.graph.edges[as_index(m_scratch.layout.edge_order[as_index(m_island.first_edge) + i])];
                    l = {edge, 0, edge.contact, state_at(edge.a), state_at(edge.b)};
                    if (l.color() == none || l.color() == color_limit)
                        some.uncolored.push_back(static_cast<std::int32_t>(i));
                    else
                        count(l, some);
                }
            });
    }

    void color_new_constraints(std::span<SlotsOfTask> tasks)
    {
        for (SlotsOfTask& some : tasks)
        {
            for (std::size_t u = 0; u < some.uncolored.size(); ++u)
            {
                prefetch_uncolored(some.uncolored, u);
                SolvedEdge& l = edges()[as_index(some.uncolored[u])];
                Contact& contact = m_state.contacts[l.contact];
                take_color(m_state, contact);
                l.flags = packed_flags(l.flags & edge_flag::all, l.points(), contact.color);
                if (contact.color == color_limit)
                    m_ctx.report.flags |= static_cast<std::uint32_t>(StepFlag::ColorsExhausted);
                count(l, some);
            }
        }
    }

    // Prefetches the contact first, then its bodies.
    [[gnu::always_inline]] void prefetch_uncolored(std::span<const std::int32_t> uncolored, std::size_t u) const
    {
        const auto contact_of = [&](std::size_t i) -> const Contact&
        { return m_state.contacts[edges()[as_index(uncolored[i])].contact]; };
        if (u + 2 * prefetch_distance < uncolored.size())
            prefetch_line(&contact_of(u + 2 * prefetch_distance));
        if (u + prefetch_distance >= uncolored.size())
            return;
        for (const std::int32_t body : {contact_of(u + prefetch_distance).body_a, contact_of(u + prefetch_distance).body_b})
            prefetch(m_state.bodies[body]);
    }

    void count(SolvedEdge& l, SlotsOfTask& some) const
    {
        const int color = l.color();
        const bool in_lane = m_island.policy.wide_contacts && color != color_limit && (m_is_uniform || give_evenly(m_ctx, l));
        l.flags = static_cast<std::uint16_t>(l.flags | (in_lane ? edge_flag::in_lane : 0));
        l.partition = static_cast<std::uint16_t>(in_lane ? partition_of(l) : 0);
        ++some.place_for(l);
        some.colors |= color != color_limit ? std::uint64_t{1} << color : 0;
        some.has_features |= in_lane && !l.has(edge_flag::plain);
    }

    // --- slots ------------------------------------------------------------------------------------------------------------------------

    // Each wide constraint has eight lanes of one partition, one color and one number of points, all with features or all without.
    void give_out_places(std::span<SlotsOfTask> tasks)
    {
        std::uint64_t colors = 0;
        bool has_features = false;
        for (const SlotsOfTask& some : tasks)
        {
            colors |= some.colors;
            has_features |= some.has_features;
        }
        m_island.colors = static_cast<std::int32_t>(std::bit_width(colors));
        auto lane = static_cast<std::int32_t>(m_scratch.layout.lane_edges.size());
        m_island.first_bucket = static_cast<std::int32_t>(m_scratch.solver.bucket_starts.size());
        m_island.bucket_count = (has_features ? 4 : 2) * m_island.colors;
        for (std::int32_t partition = 0; partition <= m_island.partitions; ++partition)
        {
            for (std::int32_t bucket = 0; bucket < m_island.bucket_count; ++bucket)
            {
                m_scratch.solver.bucket_starts.push_back(lane / lane_count - m_island.first_wide);
                give_out(
                    tasks, [&](SlotsOfTask& some) -> std::int32_t&
                    { return some.lanes[as_index(partition * buckets_to_a_partition + place_of(bucket))]; }, lane);
                lane = (lane + lane_count - 1) / lane_count * lane_count;
            }
        }
        m_scratch.solver.bucket_starts.push_back(lane / lane_count - m_island.first_wide);
        auto constraint = m_island.first_constraint;
        for_each_constraint_bucket(
            [&](int color)
            {
                give_out(tasks, [&](SlotsOfTask& some) -> std::int32_t& { return some.constraints[color]; }, constraint);
            });
        make_room(m_scratch.layout.lane_edges, as_index(lane));
        m_scratch.layout.lane_edges.resize(as_index(lane), none);
        set_size(m_scratch.layout.constraint_edges, as_index(constraint));
    }

    // Place of a bucket in SlotsOfTask::lanes.
    [[nodiscard]] int place_of(int bucket) const
    {
        const int plain = 2 * m_island.colors;
        return bucket < plain ? bucket : plain_buckets + bucket - plain;
    }

    // Replaces each task's count of a bucket by the slot of the task's first edge.
    template <class Count>
    static void give_out(std::span<SlotsOfTask> tasks, const Count& count_of, std::int32_t& place)
    {
        for (SlotsOfTask& some : tasks)
            place += std::exchange(count_of(some), place);
    }

    template <class Visit>
    void for_each_constraint_bucket(const Visit& visit) const
    {
        for (int color = 0; color < m_island.colors; ++color)
            visit(color);
        visit(color_limit);
    }

    void place(std::size_t first, SlotsOfTask& some)
    {
        for (std::size_t i = first; i < std::min(first + edges_of_task(), edges().size()); ++i)
        {
            const SolvedEdge& l = edges()[i];
            const std::int32_t at = some.place_for(l)++;
            (l.has(edge_flag::in_lane) ? m_scratch.layout.lane_edges : m_scratch.layout.constraint_edges)[as_index(at)] =
                m_island.first_edge + static_cast<std::int32_t>(i);
            if (l.has(edge_flag::in_lane) && l.points() > 0)
                add_core(l, at, some);
        }
        for (std::int32_t partition = 0; partition <= m_island.partitions; ++partition)
        {
            for (std::int32_t bucket = 0; bucket < m_island.bucket_count; ++bucket)
                some.lanes[as_index(partition * buckets_to_a_partition + place_of(bucket))] = 0;
        }
        for_each_constraint_bucket([&](int color) { some.constraints[color] = 0; });
    }

    // Balls and jointed bodies have a core against bodies that are not dynamic.
    void add_core(const SolvedEdge& l, std::int32_t lane, SlotsOfTask& some) const
    {
        const bool a_gives = is_dynamic(m_island, l.a);
        if (a_gives && is_dynamic(m_island, l.b))
            return;
        const Contact& contact = m_state.contacts[l.contact];
        const ShapeRecord& shape = m_state.shapes[a_gives ? contact.shape_a : contact.shape_b];
        if (shape.leaf.type == LeafType::Circle || m_state.bodies[shape.body].first_joint != none)
            some.cores.push_back(
                {lane - m_island.first_wide * lane_count, l.points(), core_depth(m_state, contact, contact.manifold, a_gives)});
    }

    // Cores are sorted by lane, whatever their order within a bucket: cores of one body have different colors.
    void gather(std::span<SlotsOfTask> tasks)
    {
        for (const SlotsOfTask& some : tasks)
            append_all(m_scratch.solver.cores, some.cores);
        std::ranges::sort(m_scratch.solver.cores.begin() + m_island.first_core, m_scratch.solver.cores.end(), {},
                          &WideCore::lane);
    }

    StepContext& m_ctx;
    SceneState& m_state;
    Scratch& m_scratch;
    Island& m_island;
    bool m_is_uniform = false; ///< each of its bodies may move along both axes, or along none
};

} // namespace

void sort_edges(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    sort_by_island(
        {}, scratch, scratch.graph.edges.size(), scratch.layout.edge_order, edges_per_task, [](std::size_t i)
        { return static_cast<std::int32_t>(i); }, [&](std::size_t i) { return scratch.graph.island_of_edge[i]; },
        [](Island& island, int first, int count)
        {
            island.first_edge = first;
            island.edge_count = count;
        });
    set_size(scratch.layout.solved_edges, scratch.layout.edge_order.size());
}

void place_constraints_of_small_islands(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    set_size(scratch.solver.partition_of, scratch.solver.state_bodies.size());
    scratch.layout.constraint_edges.clear();
    scratch.layout.lane_edges.clear();
    scratch.solver.cores.clear();
    scratch.solver.bucket_starts.clear();
    for (Island& island : scratch.solver.islands)
    {
        island.partitions = partitions_of(island.policy, island.dynamic_count, island.edge_count);
        if (island.partitions == 0)
            ConstraintSlots(ctx, island).find();
    }
}

void place_constraints_of_large_islands(StepContext& ctx)
{
    for (Island& island : ctx.scratch.solver.islands)
    {
        if (island.partitions > 0)
            ConstraintSlots(ctx, island).find();
    }
}

} // namespace carom::internal
