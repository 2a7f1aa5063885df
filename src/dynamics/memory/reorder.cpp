// Reordering for locality: every 32nd step, contacts move among the slots that they have to the order in which their lanes were last filled: by island, by
// color, and by body within a color. Passes over contacts then go straight through memory. Colors are chosen in that order as well, so that they remain the
// same. Bodies do not move, because their records are visited in the order of their slots.

#include "core/grow.h"
#include "core/index.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/islands/island_graph.h"
#include "dynamics/stages.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

namespace carom::internal {

namespace {

constexpr std::uint64_t steps_between = 32;
constexpr std::size_t fewest_cells = 32;
constexpr std::size_t few_of = 8;     // fewer than one in so many
constexpr std::size_t full_of = 4;    // a cell with more than one in so many bodies is too full
constexpr std::size_t worth_it = 512; // contacts; fewer stay in the cache anyway

void sort_bodies(SceneState& state)
{
    if (std::is_sorted(state.awake_bodies.begin(), state.awake_bodies.end()))
        return;
    std::sort(state.awake_bodies.begin(), state.awake_bodies.end());
    for (std::size_t i = 0; i < state.awake_bodies.size(); ++i)
        state.bodies[state.awake_bodies[i]].awake_index = static_cast<std::int32_t>(i);
}

// Powers of two. The number of cells stays the same while they have from half to twice the bodies that they should have.
std::size_t cells_for(std::size_t bodies, std::size_t cells_now)
{
    const std::size_t each = bodies / cells_now;
    if (each >= bodies_to_a_cell / 2 && each < 2 * bodies_to_a_cell)
        return cells_now;
    return std::clamp(std::bit_floor(bodies / bodies_to_a_cell), fewest_cells, std::size_t{plane_cells});
}

// Partitions the bodies into 32 cells, or more if there are more than a cache holds, along a Hilbert curve through their positions. If few bodies would change
// cells, all stay in theirs: a change makes the solver visit contacts in another order, and that disturbs bodies that are coming to rest.
void part_bodies(StepContext& ctx)
{
    SceneState& state = ctx.state;
    HilbertOrder& order = ctx.scratch.reordering.plane_order;
    order.sort(ctx.scene.def.tasks, state.awake_bodies.size(),
               [&](std::size_t i) { return to_vec2(state.sims[static_cast<std::size_t>(state.awake_bodies[i])].center); });
    const std::span<const HilbertOrder::Key> keys = order.keys();
    const auto body_of = [&](std::size_t rank) -> BodyRecord& { return state.bodies[state.awake_bodies[keys[rank].index]]; };
    std::size_t cells_now = fewest_cells;
    for (std::size_t rank = 0; rank < keys.size(); ++rank)
        cells_now = std::max(cells_now, std::bit_ceil(body_of(rank).plane_cell + std::size_t{1}));
    const std::size_t cells = cells_for(keys.size(), cells_now);
    const auto cell_of = [&](std::size_t rank) { return static_cast<std::uint8_t>(rank * cells / keys.size()); };
    std::size_t changed = 0;
    for (std::size_t rank = 0; rank < keys.size(); ++rank)
        changed += body_of(rank).plane_cell != cell_of(rank) ? 1 : 0;
    if (changed * few_of < keys.size())
        return;
    for (std::size_t rank = 0; rank < keys.size(); ++rank)
        body_of(rank).plane_cell = cell_of(rank);
}

class ContactOrder
{
public:
    explicit ContactOrder(StepContext& ctx)
        : m_state(ctx.state), m_scratch(ctx.scratch), m_order(ctx.scratch.reordering.contact_order),
          m_sorted(ctx.scratch.reordering.sorted_contacts), m_bodies(ctx.scratch.reordering.moved_to),
          m_moved_to(ctx.scratch.reordering.moved_to), m_tasks(ctx.scene.def.tasks)
    {}

    void find()
    {
        find_bodies();
        m_order.clear();
        make_room(m_order, m_state.awake_contacts.size());
        for (const Island& island : m_scratch.solver.islands)
        {
            const auto lanes = std::span(m_scratch.layout.lane_edges);
            place(lanes.subspan(static_cast<std::size_t>(island.first_wide) * lane_count,
                                static_cast<std::size_t>(island.wide_count) * lane_count));
            const auto constraints = std::span(m_scratch.layout.constraint_edges);
            place(constraints.subspan(static_cast<std::size_t>(island.first_constraint),
                                      static_cast<std::size_t>(island.constraint_count)));
        }
        ++m_color;
        for (const std::int32_t contact : m_state.awake_contacts)
            place(contact);
        sort_by(m_state.awake_bodies.size(), [this](const ContactRank& p) { return body_of(p); });
        sort_by(m_color + 1, [](const ContactRank& p) { return p.color; });
        order_equals();
    }

    [[nodiscard]] bool is_kept_already() const
    {
        for (std::size_t i = 0; i < m_order.size(); ++i)
        {
            if (m_order[i].contact != m_state.awake_contacts[i] || (i > 0 && m_order[i].contact < m_order[i - 1].contact))
                return false;
        }
        return true;
    }

    // Moves the contacts into the slots that they have among them, the lowest first.
    void apply()
    {
        std::vector<std::int32_t>& slots = m_scratch.order;
        slots.clear();
        make_room(slots, m_order.size());
        m_moved_to.assign(static_cast<std::size_t>(m_state.contacts.capacity()), none);
        for (const ContactRank& p : m_order)
            m_moved_to[as_index(p.contact)] = p.contact;
        for (std::size_t slot = 0; slot < m_moved_to.size(); ++slot)
        {
            if (m_moved_to[slot] != none)
                slots.push_back(static_cast<std::int32_t>(slot));
            m_moved_to[slot] = static_cast<std::int32_t>(slot);
        }
        m_state.awake_contacts = slots;
        for (std::size_t i = 0; i < m_order.size(); ++i)
            m_moved_to[as_index(m_order[i].contact)] = slots[i];
        move_contacts(slots);
        rename_others();
    }

private:
    // The awake index of a body, by contact; negative: the contact is not awake, or has been placed.
    void find_bodies()
    {
        m_bodies.assign(static_cast<std::size_t>(m_state.contacts.capacity()), none);
        for_each_in_chunks(m_tasks, m_state.awake_contacts.size(), contacts_per_task,
                           [&](std::size_t i)
                           {
                               const std::int32_t contact = m_state.awake_contacts[i];
                               const Contact& c = m_state.contacts[contact];
                               const std::int32_t body = is_moving_dynamic(m_state, c.body_a) ? c.body_a : c.body_b;
                               m_bodies[as_index(contact)] = std::max(m_state.bodies[body].awake_index, 0);
                           });
    }

    // Places contact edges that are solved one color after the other.
    void place(std::span<const std::int32_t> edges)
    {
        m_last = {};
        for (const std::int32_t i : edges)
        {
            if (i != none)
                place(m_scratch.layout.solved_edges[static_cast<std::size_t>(i)]);
        }
    }

    void place(const SolvedEdge& l)
    {
        if (l.color() != m_last.color() || l.points() != m_last.points())
            ++m_color;
        m_last = l;
        place(l.contact);
    }

    void place(std::int32_t contact)
    {
        std::int32_t& body = m_bodies[as_index(contact)];
        if (body < 0)
            return;
        body = ~body; // it has been placed
        m_order.push_back({m_color, contact});
    }

    // The body of a contact that has been placed.
    [[nodiscard]] std::uint32_t body_of(const ContactRank& p) const
    {
        return static_cast<std::uint32_t>(~m_bodies[as_index(p.contact)]);
    }

    // A counting sort; contacts with the same key stay in order.
    template <class Key>
    void sort_by(std::size_t keys, const Key& key)
    {
        std::vector<std::int32_t>& starts = m_scratch.order;
        starts.assign(keys + 1, 0);
        for (const ContactRank& p : m_order)
            ++starts[key(p) + 1];
        for (std::size_t k = 0; k < keys; ++k)
            starts[k + 1] += starts[k];
        set_size(m_sorted, m_order.size());
        for (const ContactRank& p : m_order)
            m_sorted[static_cast<std::size_t>(starts[key(p)]++)] = p;
        m_order.swap(m_sorted);
    }

    // Bodies that have just fallen asleep have no awake index. Their contacts are ordered by slot, whatever lanes they had.
    void order_equals()
    {
        for (auto first = m_order.begin(); first != m_order.end();)
        {
            const std::uint32_t body = body_of(*first);
            const auto last = std::find_if(first + 1, m_order.end(),
                                           [&](const ContactRank& p) { return p.color != first->color || body_of(p) != body; });
            std::sort(first, last, [](const ContactRank& a, const ContactRank& b) { return a.contact < b.contact; });
            first = last;
        }
    }

    // Moves the contacts, and renames the edges and pairs that refer to them.
    void move_contacts(const std::vector<std::int32_t>& slots)
    {
        std::ranges::fill(m_state.colors, 0); // they are chosen in the new order
        find_cycles(slots);
        run_tasks(m_tasks, 3,
                  [&](int task)
                  {
                      switch (task)
                      {
                      case 0:
                          move_items([&](int slot) -> Contact& { return m_state.contacts[slot]; });
                          break;
                      case 1:
                          move_items([&](int slot) -> CachedManifold& { return m_state.cached_manifolds[as_index(slot)]; });
                          break;
                      default:
                          move_items([&](int slot) -> ContactImpulses& { return impulses_of(m_state, slot); });
                          break;
                      }
                  });
        run_chunks(m_tasks, slots.size(), contacts_per_task,
                   [&](std::size_t first, std::size_t last)
                   {
                       for (std::size_t i = first; i < last; ++i)
                       {
                           prefetch_named(std::span(slots).subspan(i, last - i));
                           Contact& contact = m_state.contacts[slots[i]];
                           contact.awake_index = static_cast<std::int32_t>(i);
                           contact.color = none;
                           rename_edges(contact);
                           if (contact.pair != none)
                               m_state.box_pairs[as_index(contact.pair)].contact = slots[i];
                       }
                   });
    }

    // Prefetches a later contact first, then what it refers to.
    [[gnu::always_inline]] void prefetch_named(std::span<const std::int32_t> later) const
    {
        if (later.size() > 2 * prefetch_distance)
            prefetch_line(&m_state.contacts[later[2 * prefetch_distance]]);
        if (later.size() <= prefetch_distance)
            return;
        const Contact& contact = m_state.contacts[later[prefetch_distance]];
        for (const std::int32_t edge : {contact.next[0], contact.next[1], contact.previous[0], contact.previous[1]})
            prefetch_line(&m_moved_to[static_cast<std::size_t>(std::max(edge, 0) >> 1)]);
        prefetch_line(m_state.box_pairs.data() + std::max(contact.pair, 0));
    }

    // Lists the cycles of the permutation, one after the other. A contact moves to the next slot of its cycle, the last one to the first slot, which is marked.
    void find_cycles(const std::vector<std::int32_t>& slots)
    {
        std::vector<std::int32_t>& cycles = m_scratch.reordering.move_cycles;
        cycles.clear();
        for (const std::int32_t first : slots)
        {
            if (is_marked(m_moved_to[as_index(first)]) || m_moved_to[as_index(first)] == first)
                continue;
            append(cycles, marked(first));
            for (std::int32_t slot = first;;)
            {
                const std::int32_t next = std::exchange(m_moved_to[as_index(slot)], marked(m_moved_to[as_index(slot)]));
                if (next == first)
                    break;
                append(cycles, next);
                slot = next;
            }
        }
        for (std::int32_t& slot : m_moved_to)
            slot = plain(slot);
    }

    static bool is_marked(std::int32_t slot) { return slot < 0; }
    static std::int32_t marked(std::int32_t slot) { return ~slot; } // and back
    static std::int32_t plain(std::int32_t slot) { return is_marked(slot) ? marked(slot) : slot; }

    // Goes from the last slot of each cycle to its first, so that the slot to move to is always free.
    template <class At>
    void move_items(const At& at) const
    {
        static_assert(std::is_trivially_copyable_v<std::remove_reference_t<decltype(at(0))>>);
        const std::vector<std::int32_t>& cycles = m_scratch.reordering.move_cycles;
        for (std::size_t i = cycles.size(); i-- > 0;)
        {
            const auto last = at(cycles[i]);
            for (; !is_marked(cycles[i]); --i)
            {
                if (i > prefetch_distance)
                    prefetch(at(plain(cycles[i - 1 - prefetch_distance])));
                at(cycles[i]) = at(plain(cycles[i - 1]));
            }
            at(marked(cycles[i])) = last;
        }
    }

    void rename_others()
    {
        if (static_cast<std::size_t>(m_state.contacts.count()) != m_order.size())
        { // contacts that are asleep or belong to triggers
            for (int i = 0; i < m_state.contacts.capacity(); ++i)
            {
                const Contact& c = m_state.contacts[i];
                if (m_state.contacts.is_live(i) && (c.awake_index == none || (c.flags & contact_flag::trigger) != 0))
                    rename_edges(m_state.contacts[i]);
            }
        }
        for_each_in_chunks(m_tasks, static_cast<std::size_t>(m_state.bodies.capacity()), contacts_per_task,
                           [&](std::size_t i)
                           {
                               if (m_state.bodies.is_live(static_cast<int>(i)))
                                   rename(m_state.bodies[static_cast<int>(i)].first_contact);
                           });
    }

    void rename_edges(Contact& contact) const
    {
        for (int side = 0; side < 2; ++side)
        {
            rename(contact.next[side]);
            rename(contact.previous[side]);
        }
    }

    void rename(std::int32_t& edge) const
    {
        if (edge != none)
            edge = m_moved_to[static_cast<std::size_t>(edge >> 1)] * 2 + (edge & 1);
    }

    SceneState& m_state;
    Scratch& m_scratch;
    std::vector<ContactRank>& m_order;
    std::vector<ContactRank>& m_sorted;
    std::vector<std::int32_t>& m_bodies;   ///< by contact slot, while the order is computed
    std::vector<std::int32_t>& m_moved_to; ///< by contact slot, in the same memory, afterwards
    const TaskHooks& m_tasks;
    std::uint32_t m_color = 0;
    SolvedEdge m_last; ///< last contact edge that was placed in the island
};

} // namespace

void reorder(StepContext& ctx)
{
    if (ctx.state.awake_contacts.size() < worth_it)
        return;
    if (ctx.state.step_count % steps_between != 1)
    { // a body that has woken since is in no cell of its own
        if (ctx.scratch.graph.fullest_cell * full_of > ctx.state.awake_bodies.size())
            part_bodies(ctx);
        return;
    }
    sort_bodies(ctx.state);
    part_bodies(ctx);
    if (ctx.scratch.cached_constraints.unchanged_for >= steps_between)
        return; // they are still in the order of the last time
    ContactOrder order(ctx);
    order.find();
    if (order.is_kept_already())
        return;
    order.apply();
    ctx.state.lanes_stamp = 0; // the lanes refer to contact slots
}

} // namespace carom::internal
