// What takes part in a step: links of contacts and of joints between the awake bodies, found in one walk each, and who may fly as far as single bodies and
// their contacts tell. All that follows in the units stage goes by these.

#include "dynamics/unit_links.h"

#include "core/grow.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/body_store.h"
#include "dynamics/contact_update.h"
#include "dynamics/joint_bodies.h"
#include "dynamics/kept_units.h"
#include "dynamics/task_sizes.h"
#include "dynamics/wide_prepare.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

// The hinge's two points must be in one place; flight does not pull them together.
bool is_closed(const StepContext& ctx, int index, int body)
{
    const JointRecord& joint = ctx.state.joints[index];
    const auto world = [&](int b, Vec2 anchor)
    { return b == none ? Position(anchor) : transform(ctx.state.sims[static_cast<std::size_t>(b)].pose(), anchor); };
    const Vec2 gap = world(joint.body_b, joint.anchor_b) - world(joint.body_a, joint.anchor_a);
    return body != none && length(gap) <= 0.1f * ctx.scene.tolerances.slop;
}

// Who bears a load matters to rows and heaps only.
bool is_same(const Link& a, const Link& b)
{
    return a.contact == b.contact && a.a == b.a && a.b == b.b && ((a.about ^ b.about) & ~link_flag::bears) == 0;
}

// A task's walk over its contacts. Copies, not references: to a compiler every store might change where vectors are.
class ContactWalk
{
public:
    // Links of the last step, where they count, are compared with these, and give their place to them.
    ContactWalk(const StepContext& ctx, std::span<Link> links, std::size_t to_compare)
        : m_ctx(ctx), m_contacts(&ctx.state.contacts[0]), m_places(ctx.scratch.places.data()),
          m_lane_marks(ctx.state.lane_marks.data()), m_is_loaded(ctx.scratch.is_loaded.data()),
          m_nobody(static_cast<std::int32_t>(ctx.state.awake_bodies.size())), m_next(links.data()),
          m_old_end(links.data() + to_compare), m_stay(to_compare > 0)
    {}

    void prefetch(std::int32_t index) const { internal::prefetch(m_contacts[index]); }

    // Links it where it takes part in the step. Whom it loads does not fly.
    void visit(std::int32_t index)
    {
        Contact& contact = m_contacts[index];
        m_lane_marks[index] = LaneMark::None;
        contact.wide = none;
        const bool touching = (contact.flags & contact_flag::touching) != 0;
        const bool solved = is_solved(contact);
        if (!solved)
            leave_row(m_ctx.state, index);
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
        link(index, a, b, about(contact, solved));
        m_touching += touching ? 1 : 0;
    }

    void tell(SomeLinks& some) const
    {
        some.touching = m_touching;
        some.stay = m_stay && m_next == m_old_end;
        some.links.resize(static_cast<std::size_t>(m_next - some.links.data()));
    }

private:
    [[nodiscard]] static std::uint16_t about(const Contact& contact, bool solved)
    {
        const bool plain = contact.rolling_resistance == 0 && contact.surface_speed == 0;
        const std::uint32_t flags = contact.flags & (link_flag::touching | link_flag::round | link_flag::bears);
        return about_link(flags | (solved ? link_flag::solved : 0) | (plain ? link_flag::plain : 0), contact.manifold.count,
                          contact.color);
    }

    // Filled where it stands: a copy would wait for its bytes.
    void link(std::int32_t contact, std::int32_t a, std::int32_t b, std::uint16_t about)
    {
        Link& l = *m_next;
        if (m_stay)
            m_stay = m_next < m_old_end && is_same(l, {contact, a, b, about});
        l.contact = contact;
        l.a = a;
        l.b = b;
        l.about = about;
        l.bin = 0;
        ++m_next;
    }

    // Others may do so as well. The last mark is nobody's: a branch here would be guessed wrong.
    void note_load(std::int32_t place, bool loaded) const
    {
        const std::int32_t marked = loaded && place >= 0 ? place : m_nobody;
        std::atomic_ref(m_is_loaded[marked]).store(1, std::memory_order_relaxed);
    }

    const StepContext& m_ctx;
    Contact* m_contacts;
    const std::int32_t* m_places;
    LaneMark* m_lane_marks;
    std::uint8_t* m_is_loaded;
    std::int32_t m_nobody;
    Link* m_next;
    const Link* m_old_end;
    bool m_stay;
    int m_touching = 0;
};

class LinkGathering
{
public:
    explicit LinkGathering(StepContext& context) : ctx(context), state(context.state), scratch(context.scratch) {}

    void find_fliers()
    {
        scratch.flight.assign(state.awake_bodies.size(), earthbound);
        scratch.grounded.assign(state.awake_bodies.size(), earthbound);
        scratch.is_loaded.assign(state.awake_bodies.size() + 1, 0);
        scratch.has_uneven = scratch.has_kinematic = scratch.has_hung = false;
        forget_places();
        for_each_in_parts(ctx.scene.def.tasks, state.awake_bodies.size(), bodies_per_task,
                          [&](std::size_t i)
                          {
                              prefetch_hinge_of(i + turns_ahead);
                              const int body = state.awake_bodies[i];
                              note_place(body, static_cast<std::int32_t>(i));
                              note_uneven(body);
                              if (ctx.scene.def.continuous)
                                  scratch.flight[i] = kind_of_flight(body);
                          });
    }

    // The one walk over all contacts, on all threads; what follows goes over the links. Links of the last step are compared with these, and give their place
    // to them.
    void gather_contacts()
    {
        const TaskHooks& tasks = ctx.scene.def.tasks;
        const std::size_t contacts = state.awake_contacts.size();
        const std::size_t part = part_of(contacts, contacts_per_task);
        const bool in_place = contacts > 0 && contacts <= part;
        if (in_place)
        {
            scratch.links_of_task.resize(std::max<std::size_t>(scratch.links_of_task.size(), 1));
            scratch.links.swap(scratch.links_of_task[0].links);
        }
        const std::span<SomeLinks> parts =
            find_in_parts(tasks, contacts, part, scratch.links_of_task, [&](std::size_t first, std::size_t last, SomeLinks& some)
                          { gather_some(first, last, in_place && scratch.kept_units.are_plain, some); });
        if (in_place)
        {
            scratch.links.swap(parts[0].links);
            scratch.kept_units.links_stay = parts[0].stay;
            ctx.report.touching += parts[0].touching;
        }
        else
        {
            join_links(parts);
        }
    }

    // A body that a contact loads does not fly.
    void list_fliers()
    {
        scratch.flying.clear();
        for (std::size_t i = 0; i < scratch.flight.size(); ++i)
        {
            if (scratch.is_loaded[i] != 0)
                scratch.grounded[i] = std::exchange(scratch.flight[i], earthbound);
            if (scratch.flight[i] != earthbound)
                scratch.flying.push_back(static_cast<std::int32_t>(i));
        }
    }

    // The same for joints. But for what may fly, their links say nothing that a step changes.
    void gather_joints()
    {
        KeptUnits& kept = scratch.kept_units;
        kept.stay_so = kept.are_plain && !state.graph_dirty && bodies_stay(ctx);
        kept.joints_stay = kept.stay_so && !scratch.has_hung && !kept.has_hung;
        kept.has_hung = scratch.has_hung;
        if (kept.joints_stay)
            return;
        scratch.joint_links.swap(kept.joints);
        using Some = std::vector<JointLink>;
        const auto joints = static_cast<std::size_t>(state.joints.capacity());
        const std::span<Some> parts =
            find_in_parts(ctx.scene.def.tasks, joints, part_of(joints, joints_per_task), scratch.joints_of_task,
                          [&](std::size_t first, std::size_t last, Some& some)
                          {
                              some.clear();
                              for (auto j = static_cast<int>(first); j < static_cast<int>(last); ++j)
                              {
                                  if (state.joints.is_live(j))
                                      gather_joint(j, some);
                              }
                          });
        if (parts.size() == 1)
        {
            scratch.joint_links.swap(parts[0]);
            return;
        }
        scratch.joint_links.clear();
        for (const Some& some : parts)
            append_all(scratch.joint_links, some);
    }

private:
    // What may turn about the world hangs on one joint alone.
    [[gnu::always_inline]] void prefetch_hinge_of(std::size_t place) const
    {
        if (place >= state.awake_bodies.size())
            return;
        const BodyRecord& record = state.bodies[state.awake_bodies[place]];
        if (record.joint_count == 1)
            prefetch(state.joints[record.first_joint >> 1]);
    }

    // Of the bodies that were awake in the last step alone: what never moves costs nothing.
    void forget_places()
    {
        for (const std::int32_t body : scratch.placed)
            scratch.places[static_cast<std::size_t>(body)] = none;
        scratch.placed.assign(state.awake_bodies.begin(), state.awake_bodies.end());
        scratch.places.resize(std::max(scratch.places.size(), static_cast<std::size_t>(state.bodies.capacity())), none);
    }

    void note_place(int body, std::int32_t place) const
    {
        const bool dynamic = state.bodies[body].type == BodyType::Dynamic;
        scratch.places[static_cast<std::size_t>(body)] = dynamic ? place : -2 - place;
        if (!dynamic)
            std::atomic_ref(scratch.has_kinematic).store(true, std::memory_order_relaxed);
    }

    void note_uneven(int body) const
    {
        const MotionLocks locks = state.bodies[body].locks;
        if (locks.linear_x != locks.linear_y)
            std::atomic_ref(scratch.has_uneven).store(true, std::memory_order_relaxed);
    }

    [[nodiscard]] std::int32_t kind_of_flight(int body) const
    {
        if (state.bodies[body].type != BodyType::Dynamic)
            return earthbound;
        const std::int32_t kind = flight_of(state, body);
        if (kind == earthbound || kind == none)
            return kind;
        if (!is_closed(ctx, kind, body))
            return earthbound;
        std::atomic_ref(scratch.has_hung).store(true, std::memory_order_relaxed);
        return kind;
    }

    void join_links(std::span<SomeLinks> parts)
    {
        std::size_t count = 0;
        for (SomeLinks& some : parts)
        {
            some.first = count;
            count += some.links.size();
            ctx.report.touching += some.touching;
        }
        const bool may_stay = scratch.kept_units.are_plain && scratch.links.size() == count;
        set_size(scratch.links, count);
        for_each_in_parts(ctx.scene.def.tasks, parts.size(), 4,
                          [&](std::size_t i)
                          {
                              const auto to = scratch.links.begin() + static_cast<std::ptrdiff_t>(parts[i].first);
                              parts[i].stay = may_stay && std::equal(parts[i].links.begin(), parts[i].links.end(), to, is_same);
                              std::copy(parts[i].links.begin(), parts[i].links.end(), to);
                          });
        scratch.kept_units.links_stay = may_stay && std::ranges::all_of(parts, &SomeLinks::stay);
    }

    // One thread alone finds all in one place.
    [[nodiscard]] std::size_t part_of(std::size_t count, std::size_t per_task) const
    {
        return ctx.scene.def.tasks.worker_count > 1 ? per_task : std::max(count, per_task);
    }

    void gather_some(std::size_t first, std::size_t last, bool compare, SomeLinks& some) const
    {
        const std::size_t before = some.links.size();
        set_size(some.links, std::max(before, last - first));
        ContactWalk walk(ctx, some.links, compare ? before : 0);
        const std::int32_t* const indices = state.awake_contacts.data();
        for (std::size_t i = first; i < last; ++i)
        {
            if (i + turns_ahead < last)
                walk.prefetch(indices[i + turns_ahead]);
            walk.visit(indices[i]);
        }
        walk.tell(some);
    }

    void gather_joint(int index, std::vector<JointLink>& links) const
    {
        const JointRecord& joint = state.joints[index];
        const auto place = [&](int body) { return body == none ? none : place_of(scratch, body); };
        const auto takes_part = [&](int body, std::int32_t at)
        { return at != none || body == none || state.bodies[body].enabled; };
        const std::int32_t a = place(joint.body_a);
        const std::int32_t b = place(joint.body_b);
        if ((a < 0 && b < 0) || !takes_part(joint.body_a, a) || !takes_part(joint.body_b, b))
            return;
        JointLink& link = links.emplace_back();
        link.joint = index;
        link.a = a;
        link.b = b;
        link.hinge = fits_joint_lane(joint);
        link.holds = only_holds(joint);
        link.damped = loses_energy(joint);
        link.binds = !link.holds && joint.kind != JointType::Spring;
        link.flies = may_fly(a) || may_fly(b);
    }

    // About a hinge to the world.
    [[nodiscard]] bool may_fly(std::int32_t place) const
    {
        return place >= 0 && (scratch.flight[static_cast<std::size_t>(place)] != earthbound ||
                              scratch.grounded[static_cast<std::size_t>(place)] != earthbound);
    }

    StepContext& ctx;
    SceneState& state;
    Scratch& scratch;
};

} // namespace

std::int32_t flight_about_hinge(const SceneState& state, int body)
{
    const BodyRecord& record = state.bodies[body];
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    const int edge = record.first_joint;
    if (record.joint_count != 1)
        return earthbound;
    const JointRecord& joint = state.joints[edge >> 1];
    const int other = joint.body_a == body ? joint.body_b : joint.body_a;
    const bool hinged = joint.kind == JointType::Revolute && !joint.enable_motor && joint.hertz == 0 &&
                        (other == none || state.bodies[other].type == BodyType::Static) && sim.inverse_inertia > 0;
    if (!hinged)
        return earthbound;
    // A body that may not move along is held twice: it turns only if the pivot is its center of mass.
    const Vec2 anchor = joint.body_a == body ? joint.anchor_a : joint.anchor_b;
    const bool centered = anchor == sim.local_center;
    return centered || (sim.inverse_mass.x > 0 && sim.inverse_mass.y > 0) ? edge >> 1 : earthbound;
}

void gather_links(StepContext& ctx)
{
    LinkGathering gathering(ctx);
    gathering.find_fliers();
    gathering.gather_contacts();
    gathering.list_fliers();
    gathering.gather_joints();
}

} // namespace carom::internal
