// Contact edges are in the order of the awake contacts. Edges of chain pieces and of sleeping bodies come last, because other contacts may still affect them.

#include "dynamics/islands/contact_edges.h"

#include "core/compiler.h"
#include "core/grow.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/islands/joint_edges.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

namespace carom::internal {

namespace {

constexpr std::size_t parts_joined_at_once = 8;

// Whether an edge bears a load matters only to constraints outside of lanes and to islands with soft joints.
bool is_same(const ContactEdge& a, const ContactEdge& b)
{
    return a.contact == b.contact && a.a == b.a && a.b == b.b && ((a.flags ^ b.flags) & ~edge_flag::bears) == 0;
}

// A walk over contacts. It copies pointers: to a compiler, every store might change the vectors behind references.
class ContactWalk
{
public:
    ContactWalk(const StepContext& ctx, EdgesOfTask& some)
        : m_ctx(ctx), m_contacts(&ctx.state.contacts[0]), m_places(ctx.scratch.graph.places.data()),
          m_lane_marks(ctx.state.lane_marks.data()), m_is_loaded(ctx.scratch.graph.is_loaded.data()),
          m_nobody(static_cast<std::int32_t>(ctx.state.awake_bodies.size())), m_next(some.edges.data() + some.count),
          m_old_end(some.edges.data() + some.to_compare), m_stay(some.stay), m_touching(some.touching)
    {}

    // Adds an edge where the contact takes part in the step. A body that it loads does not fly.
    CAROM_INLINE void visit(std::int32_t index)
    {
        Contact& contact = m_contacts[index];
        m_lane_marks[index] = LaneMark::None;
        contact.wide = none;
        const bool touching = touches(contact);
        const bool solved = is_solved(contact);
        if (!solved)
            leave_constraint(m_ctx.state, index);
        if (!touching && !solved)
            return;
        const std::int32_t a = m_places[contact.body_a];
        const std::int32_t b = m_places[contact.body_b];
        if (a < 0 && b < 0)
        {
            leave_color(m_ctx.state, contact);
            return;
        }
        const bool loaded = solved && is_loaded(m_ctx, contact, least_separation(contact.manifold));
        note_load(a, loaded);
        note_load(b, loaded);
        if ((contact.flags & contact_flag::bounces) != 0 && solved && meets_soon(contact)) [[unlikely]]
            note_bounce(a, b);
        edge(index, a, b, flags(contact, solved));
        m_touching += touching ? 1 : 0;
    }

    void leave(EdgesOfTask& some) const
    {
        some.count = static_cast<std::size_t>(m_next - some.edges.data());
        some.stay = m_stay;
        some.touching = m_touching;
    }

private:
    [[nodiscard]] static std::uint16_t flags(const Contact& contact, bool solved)
    {
        const bool plain = contact.rolling_resistance == 0 && contact.surface_speed == 0;
        const std::uint32_t flags = contact.flags & (edge_flag::touching | edge_flag::round | edge_flag::bears);
        return packed_flags(flags | (solved ? edge_flag::solved : 0) | (plain ? edge_flag::plain : 0), contact.manifold.count,
                            contact.color);
    }

    // Filled in place: a copy would stall until its separate stores are complete.
    void edge(std::int32_t contact, std::int32_t a, std::int32_t b, std::uint16_t flags)
    {
        ContactEdge& l = *m_next;
        if (m_stay)
            m_stay = m_next < m_old_end && is_same(l, {{flags}, contact, a, b});
        l.contact = contact;
        l.a = a;
        l.b = b;
        l.flags = flags;
        ++m_next;
    }

    // Atomic: several threads may mark a body. The last mark is a dummy instead of a branch, which would be mispredicted.
    void note_load(std::int32_t place, bool loaded) const
    {
        const std::int32_t marked = loaded && place >= 0 ? place : m_nobody;
        std::atomic_ref(m_is_loaded[marked]).store(1, std::memory_order_relaxed);
    }

    // Within the step, or within the sub-step after it, which the solver's relaxation looks ahead to.
    [[nodiscard]] bool meets_soon(const Contact& contact) const
    {
        const float ahead = 1 + 1 / static_cast<float>(m_ctx.substeps);
        return !means_apart(contact) || least_separation(contact.manifold) <= ahead * relative_motion(m_ctx.state, contact) +
                                                                                  0.1f * m_ctx.scene.tolerances.speculation;
    }

    void note_bounce(std::int32_t a, std::int32_t b) const
    {
        for (const std::int32_t place : {a, b})
        {
            if (place >= 0)
                std::atomic_ref(m_ctx.scratch.graph.may_bounce[static_cast<std::size_t>(place)])
                    .store(1, std::memory_order_relaxed);
        }
    }

    const StepContext& m_ctx;
    Contact* m_contacts;
    const std::int32_t* m_places;
    LaneMark* m_lane_marks;
    std::uint8_t* m_is_loaded;
    std::int32_t m_nobody;
    ContactEdge* m_next;
    const ContactEdge* m_old_end;
    bool m_stay;
    int m_touching;
};

} // namespace

ContactEdges::ContactEdges(StepContext& ctx, std::size_t contacts_to_a_task)
    : m_ctx(ctx), m_contacts_to_a_task(contacts_to_a_task), m_alone(ctx.scene.def.tasks.worker_count <= 1)
{
    Scratch& scratch = ctx.scratch;
    forget_bodies(ctx);
    place_bodies(ctx);
    if (!m_alone)
    {
        add_tasks(ctx.state.awake_contacts.size(), contacts_to_a_task);
        return;
    }
    add_tasks(1, 1);
    // Edges of the last step are compared with the new ones and overwritten by them.
    EdgesOfTask& all = edges_of(0);
    all.edges.swap(scratch.graph.edges);
    all.stay = scratch.cached_graph.is_valid;
    all.to_compare = all.stay ? all.edges.size() : 0;
    set_size(all.edges, std::max(all.edges.size(), ctx.state.awake_contacts.size()));
}

// Adds tasks that have found no edges yet.
void ContactEdges::add_tasks(std::size_t contacts, std::size_t contacts_to_a_task)
{
    std::vector<EdgesOfTask>& all = m_ctx.scratch.graph.edges_of_task;
    const std::size_t first = m_tasks;
    m_tasks += (contacts + contacts_to_a_task - 1) / contacts_to_a_task;
    all.resize(std::max(all.size(), m_tasks));
    for (std::size_t task = first; task < m_tasks; ++task)
    {
        EdgesOfTask& some = all[task];
        set_size(some.edges, std::max(some.edges.size(), contacts_to_a_task));
        some.count = some.to_compare = 0;
        some.stay = false;
        some.touching = 0;
    }
}

EdgesOfTask& ContactEdges::edges_of(std::size_t task) { return m_ctx.scratch.graph.edges_of_task[m_alone ? 0 : task]; }

void ContactEdges::ask(std::size_t first, std::size_t last, std::vector<std::int32_t>& later)
{
    EdgesOfTask& some = edges_of(first / m_contacts_to_a_task);
    ContactWalk walk(m_ctx, some);
    later.clear();
    for (const std::int32_t contact : std::span(m_ctx.state.awake_contacts).subspan(first, last - first))
    {
        if (concerns_no_other(m_ctx.state.contacts[contact]))
            walk.visit(contact);
        else
            append(later, contact);
    }
    walk.leave(some);
}

void ContactEdges::ask_later(std::span<const std::int32_t> contacts)
{
    place_bodies(m_ctx);
    const std::size_t first_task = m_tasks;
    if (m_alone)
        set_size(edges_of(0).edges, std::max(edges_of(0).edges.size(), m_ctx.state.awake_contacts.size()));
    else
        add_tasks(contacts.size(), contacts_per_task);
    run_chunks(m_ctx.scene.def.tasks, contacts.size(), contacts_per_task,
               [&](std::size_t first, std::size_t last)
               {
                   EdgesOfTask& some = edges_of(first_task + first / contacts_per_task);
                   ContactWalk walk(m_ctx, some);
                   for (std::size_t i = first; i < last; ++i)
                   {
                       if (i + prefetch_distance < last)
                           prefetch(m_ctx.state.contacts[contacts[i + prefetch_distance]]);
                       walk.visit(contacts[i]);
                   }
                   walk.leave(some);
               });
}

void ContactEdges::join()
{
    Scratch& scratch = m_ctx.scratch;
    const std::span<EdgesOfTask> parts = std::span(scratch.graph.edges_of_task).first(m_tasks);
    std::size_t count = 0;
    for (EdgesOfTask& some : parts)
    {
        some.first = count;
        count += some.count;
        m_ctx.report.touching += some.touching;
    }
    if (m_alone)
    {
        parts[0].edges.resize(count);
        scratch.graph.edges.swap(parts[0].edges);
        scratch.cached_graph.edges_are_unchanged = parts[0].stay && count == parts[0].to_compare;
        return;
    }
    const bool may_stay = scratch.cached_graph.is_valid && scratch.graph.edges.size() == count;
    set_size(scratch.graph.edges, count);
    for_each_in_chunks(m_ctx.scene.def.tasks, parts.size(), parts_joined_at_once,
                       [&](std::size_t i)
                       {
                           const auto found = std::span(parts[i].edges).first(parts[i].count);
                           const auto to = scratch.graph.edges.begin() + static_cast<std::ptrdiff_t>(parts[i].first);
                           parts[i].stay = may_stay && std::equal(found.begin(), found.end(), to, is_same);
                           std::ranges::copy(found, to);
                       });
    scratch.cached_graph.edges_are_unchanged = may_stay && std::ranges::all_of(parts, &EdgesOfTask::stay);
}

} // namespace carom::internal
