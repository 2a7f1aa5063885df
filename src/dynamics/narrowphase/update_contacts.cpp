// Stage 3, contacts: manifolds of awake pairs, begins and ends of touches, and contact edges (contact_edges.cpp). The first pass writes to its own contacts,
// and marks bodies in ways that commute; it may run on any thread. The second goes through the results in order.

#include "core/grow.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/islands/contact_edges.h"
#include "dynamics/narrowphase/cached_constraints.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/narrowphase/manifold_cache.h"
#include "dynamics/narrowphase/material.h"
#include "dynamics/narrowphase/touch_tracker.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/stages.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

// A shape that comes from behind passes until it is free of the one-way shape; so does one that already overlaps deeply.
void update_passing(const StepContext& ctx, Contact& contact)
{
    const float least = least_separation(contact.manifold);
    const float slop = ctx.scene.tolerances.slop;
    const bool behind =
        contact.manifold.count > 0 && lets_pass(ctx.scene, contact.shape_a, contact.shape_b, contact.manifold.normal);
    if (least > slop)
        contact.flags = behind ? contact.flags | contact_flag::passing : contact.flags & ~contact_flag::passing;
    else if (!touches(contact) && (behind || least < -4 * slop))
        contact.flags |= contact_flag::passing;
}

void find_manifold(const StepContext& ctx, int index)
{
    SceneState& state = ctx.state;
    Contact& contact = state.contacts[index];
    const Manifold old = contact.manifold;
    const BodyPose pose_a = pose_at_start(state, contact.body_a);
    const BodyPose pose_b = pose_at_start(state, contact.body_b);
    const LocalManifold found =
        local_manifold(state, contact, pose_a, pose_b, ctx.scene.tolerances.speculation + relative_motion(state, contact));
    contact.manifold = in_world(found, pose_a, pose_b);
    carry_impulses(old, contact.manifold, impulses_of(state, index));
    contact.flags &= ~(contact_flag::all_cached | contact_flag::followed | contact_flag::of_union);
    contact.flags |= found.is_of_union ? contact_flag::of_union : 0u;
}

void update_manifold(const StepContext& ctx, int index)
{
    Contact& contact = ctx.state.contacts[index];
    if (caches_manifold(ctx.state, contact))
        follow_manifold(ctx, index);
    else
        find_manifold(ctx, index);
    if ((contact.flags & contact_flag::one_way) != 0)
        update_passing(ctx, contact);
}

bool should_touch(const StepContext& ctx, const Contact& contact)
{
    if ((contact.flags & contact_flag::passing) != 0)
        return false;
    // Parting takes twice the distance, so that contacts at the limit do not flicker.
    const float limit = touches(contact) ? 2 * ctx.scene.tolerances.slop : ctx.scene.tolerances.slop;
    return least_separation(contact.manifold) <= limit;
}

// The other shape of a contact with a piece of a chain.
int visitor_of(const SceneState& state, const Contact& contact)
{
    return state.shapes[contact.shape_a].owner != contact.shape_a ? contact.shape_b : contact.shape_a;
}

// A ball that rolled over a seam brings along its load on the previous piece. The walk over contacts is only for the few shapes that have just left a piece.
void inherit_load(StepContext& ctx, int index)
{
    SceneState& state = ctx.state;
    Contact& contact = state.contacts[index];
    if ((contact.flags & contact_flag::piece) == 0 || (contact.flags & contact_flag::loaded) != 0)
        return;
    const int visitor = visitor_of(state, contact);
    if (!std::ranges::binary_search(ctx.scratch.narrow.left_loads, visitor))
        return;
    const bool piece_is_a = visitor == contact.shape_b;
    const int piece = piece_is_a ? contact.shape_a : contact.shape_b;
    for_each_contact(state, state.shapes[visitor].body,
                     [&](int other_index)
                     {
                         Contact& other = state.contacts[other_index];
                         if ((other.flags & contact_flag::loaded) == 0 || other.manifold.count > 0)
                             return;
                         const int other_piece = piece_is_a ? other.shape_a : other.shape_b;
                         const int other_visitor = piece_is_a ? other.shape_b : other.shape_a;
                         if (other_visitor != visitor || state.shapes[other_piece].owner != state.shapes[piece].owner)
                             return;
                         contact.flags |= contact_flag::loaded;
                         other.flags &= ~contact_flag::loaded;
                         contact.manifold.rolling_impulse = other.manifold.rolling_impulse;
                         const PointImpulses& borne = impulses_of(state, other_index).points[0];
                         impulses_of(state, index).points[0] = borne;
                     });
}

void wake_both(StepContext& ctx, int index)
{
    const Contact& contact = ctx.state.contacts[index];
    wake_body(ctx.scene, contact.body_a);
    wake_body(ctx.scene, contact.body_b);
}

// Begins a touch with the load of a neighboring piece, and wakes both bodies.
void begin_loaded_touch(StepContext& ctx, int index)
{
    note_begin(ctx.state.contacts[index]);
    inherit_load(ctx, index);
    wake_both(ctx, index);
    begin_touch(ctx.scene, index);
}

// Like wake_body, for an awake body. Threads may call it in parallel.
void keep_awake(const StepContext& ctx, int body)
{
    const std::atomic_ref sleep_time(ctx.state.sims[static_cast<std::size_t>(body)].sleep_time);
    if (sleep_time.load(std::memory_order_relaxed) != 0)
        sleep_time.store(0, std::memory_order_relaxed);
}

// A fast body that may hit a sleeper in this step wakes it before the islands are built.
bool may_hit(const StepContext& ctx, const Contact& contact)
{
    const bool moves = relative_motion(ctx.state, contact) > ctx.scene.tolerances.speculation;
    return moves && (contact.flags & contact_flag::passing) == 0;
}

TouchChange change_of(const StepContext& ctx, const Contact& contact)
{
    const bool touching = touches(contact);
    const bool should = should_touch(ctx, contact);
    if (should != touching)
        return touching ? TouchChange::Ends : TouchChange::Begins;
    if (touching || contact.manifold.count == 0)
        return TouchChange::Nothing;
    return (contact.flags & contact_flag::sleeper) != 0 && may_hit(ctx, contact) ? TouchChange::MayHit : TouchChange::Nothing;
}

} // namespace

TouchChange update_contact(const StepContext& ctx, int index)
{
    Contact& contact = ctx.state.contacts[index];
    update_manifold(ctx, index);
    contact.flags &= ~contact_flag::fresh;
    return change_of(ctx, contact);
}

namespace {

constexpr std::size_t contacts_at_once = 512;

// True if refresh_cached_constraints has already updated the contact in this step.
bool is_looked_at(const Scratch& scratch, std::int32_t contact)
{
    return !scratch.narrow.is_looked_at.empty() && scratch.narrow.is_looked_at[static_cast<std::size_t>(contact)] != 0;
}

// Updates a task's contacts and collects their changes. Writes to these contacts alone.
class ContactUpdate
{
public:
    ContactUpdate(const StepContext& ctx, std::size_t first, std::size_t last, ContactChanges& some)
        : m_ctx(ctx), m_contacts(std::span(ctx.state.awake_contacts).subspan(first, last - first)), m_first(first), m_some(some),
          m_scene(followed_scene(ctx))
    {}

    void run()
    {
        m_some.begins.clear();
        m_some.ends.clear();
        m_some.others.clear();
        m_some.left_loads.clear();
        for (std::size_t i = 0; i < m_contacts.size(); ++i)
        {
            prefetch_later(i);
            update(i);
        }
        for (const Waiting& w : m_waiting)
        {
            for (int i = 0; i < w.count; ++i)
                put_off(w.places[i]);
        }
        update_the_others();
        for (std::size_t i = 0; i < m_contacts.size(); ++i)
        {
            if (m_changes[i] != TouchChange::Nothing)
                report(m_contacts[i], m_changes[i]);
        }
    }

private:
    // Prefetches the contact first, then its cached manifold and its bodies. The prefetch distance is doubled, because iterations are short here.
    [[gnu::always_inline]] void prefetch_later(std::size_t i) const
    {
        constexpr std::size_t ahead = 2 * prefetch_distance;
        const SceneState& state = m_ctx.state;
        if (i + 2 * ahead < m_contacts.size())
            prefetch(state.contacts[m_contacts[i + 2 * ahead]]);
        if (i + ahead >= m_contacts.size())
            return;
        const std::int32_t index = m_contacts[i + ahead];
        prefetch(state.cached_manifolds[static_cast<std::size_t>(index)]);
        for (const std::int32_t body : {state.contacts[index].body_a, state.contacts[index].body_b})
            prefetch_line(&state.sims[static_cast<std::size_t>(body)]); // the half that neighbors read
    }

    // Events are written later, see report_noted_begins.
    void report(std::int32_t index, TouchChange what)
    {
        Contact& contact = m_ctx.state.contacts[index];
        if (!concerns_no_other(contact))
        {
            append(m_some.others, {index, what});
        }
        else if (what == TouchChange::Begins)
        {
            note_begin(contact);
            keep_awake(m_ctx, contact.body_a);
            keep_awake(m_ctx, contact.body_b);
            append(m_some.begins, index);
        }
        else if (what == TouchChange::Ends)
        {
            note_end(contact);
            append(m_some.ends, index);
        }
    }

    void update(std::size_t i)
    {
        const std::int32_t index = m_contacts[i];
        Contact& contact = m_ctx.state.contacts[index];
        contact.awake_index = static_cast<std::int32_t>(m_first + i); // see ContactBatch::find_slots
        if (is_looked_at(m_ctx.scratch, index))
        {
            m_changes[i] = change_of(m_ctx, contact);
            note_left_load(contact);
            return;
        }
        if (!is_updated_with_others(m_ctx.state, contact))
        {
            put_off(i);
            return;
        }
        Waiting& w = m_waiting[contact.manifold.count];
        w.contacts.v[w.count] = index;
        w.places[w.count++] = i;
        if (w.count < lane_count)
            return;
        if (contact.manifold.count == 0)
            look_whether_apart(w);
        else
            follow_together(contact.manifold.count, w);
        w.count = 0;
    }

    // A contact that cannot be updated in a batch mostly needs a new manifold: its shapes are prefetched now, their corners shortly before its update.
    void put_off(std::size_t i)
    {
        const SceneState& state = m_ctx.state;
        const Contact& contact = state.contacts[m_contacts[i]];
        for (const std::int32_t shape : {contact.shape_a, contact.shape_b})
            prefetch_line(&state.shapes[shape]);
        m_others[m_other_count++] = i;
    }

    void update_the_others()
    {
        for (std::size_t k = 0; k < m_other_count; ++k)
        {
            if (k + prefetch_distance < m_other_count)
                prefetch_corners(m_contacts[m_others[k + prefetch_distance]]);
            const std::int32_t index = m_contacts[m_others[k]];
            m_changes[m_others[k]] = update_contact(m_ctx, index);
            note_left_load(m_ctx.state.contacts[index]);
        }
    }

    // For a contact that now begins to touch the next piece.
    void note_left_load(const Contact& contact)
    {
        constexpr std::uint32_t loaded_piece = contact_flag::piece | contact_flag::loaded;
        if (contact.manifold.count == 0 && (contact.flags & loaded_piece) == loaded_piece)
            append(m_some.left_loads, visitor_of(m_ctx.state, contact));
    }

    [[gnu::always_inline]] void prefetch_corners(std::int32_t index) const
    {
        const SceneState& state = m_ctx.state;
        prefetch_line(&impulses_of(state, index));
        for (const std::int32_t shape : {state.contacts[index].shape_a, state.contacts[index].shape_b})
        {
            const LeafView leaf = leaf_view(state, shape);
            prefetch_line(leaf.points);
            prefetch_line(leaf.normals);
        }
    }

    // Contacts that wait for a batch with the same number of points.
    struct Waiting
    {
        LaneInts contacts{};
        std::size_t places[lane_count]{};
        int count = 0;
    };

    // A contact that stays without a point is unchanged.
    void look_whether_apart(const Waiting& w)
    {
        const std::uint32_t apart = m_kernels.stay_apart(w.contacts, m_scene);
        for (int i = 0; i < lane_count; ++i)
        {
            if ((apart >> i & 1u) == 0)
                put_off(w.places[i]);
            else
                m_changes[w.places[i]] = TouchChange::Nothing;
        }
    }

    void follow_together(int points, const Waiting& w)
    {
        FollowedContacts found;
        m_kernels.follow_contacts(w.contacts, points, &m_ctx.state.contacts[0], m_scene, found);
        for (int i = 0; i < lane_count; ++i)
        {
            Contact& contact = m_ctx.state.contacts[w.contacts.v[i]];
            contact.flags &= ~contact_flag::followed;
            if ((found.sure >> i & 1u) == 0)
                put_off(w.places[i]);
            else
                m_changes[w.places[i]] = (found.touch_on >> i & 1u) != 0 ? TouchChange::Nothing : change_of(m_ctx, contact);
        }
    }

    const StepContext& m_ctx;
    std::span<const std::int32_t> m_contacts;
    std::size_t m_first; ///< index among the awake contacts
    ContactChanges& m_some;
    FollowedScene m_scene;
    TouchChange m_changes[contacts_at_once];
    std::size_t m_others[contacts_at_once];
    std::size_t m_other_count = 0;
    Waiting m_waiting[3]; ///< by number of points: none, one, two
    const WideKernels& m_kernels = wide_kernels();
};

// Concatenates a list of all tasks, in their order.
std::span<const std::int32_t> gather(StepContext& ctx, std::span<const ContactChanges> parts,
                                     std::vector<std::int32_t> ContactChanges::* which)
{
    std::vector<std::int32_t>& contacts = ctx.scratch.order;
    contacts.clear();
    for (const ContactChanges& some : parts)
        append_all(contacts, some.*which);
    return contacts;
}

} // namespace

void update_contacts(StepContext& ctx)
{
    if (refresh_cached_constraints(ctx))
    {
        ctx.report.pairs = static_cast<int>(ctx.state.awake_contacts.size());
        ctx.report.touching = ctx.scratch.cached_constraints.touching;
        return;
    }
    SceneState& state = ctx.state;
    const std::size_t count = state.awake_contacts.size();
    ContactEdges links(ctx, contacts_at_once);
    const std::span<ContactChanges> parts =
        find_in_chunks(ctx.scene.def.tasks, count, contacts_at_once, ctx.scratch.narrow.changes_of_task,
                       [&](std::size_t first, std::size_t last, ContactChanges& some)
                       {
                           ContactUpdate(ctx, first, last, some).run();
                           links.ask(first, last, some.of_others);
                       });
    std::vector<ContactChange>& changes = ctx.scratch.narrow.changes;
    std::vector<std::int32_t>& of_others = ctx.scratch.narrow.of_others;
    changes.clear();
    of_others.clear();
    ctx.scratch.narrow.left_loads.clear();
    for (const ContactChanges& some : parts)
    {
        append_all(changes, some.others);
        append_all(of_others, some.of_others);
        append_all(ctx.scratch.narrow.left_loads, some.left_loads);
    }
    std::ranges::sort(ctx.scratch.narrow.left_loads);
    report_noted_begins(ctx, gather(ctx, parts, &ContactChanges::begins));
    report_noted_ends(ctx, gather(ctx, parts, &ContactChanges::ends));
    // Woken contacts keep the manifold with which they fell asleep; it is still valid. Begins come first, so that a chain left over one piece and touched over
    // the next is never let go.
    for (const ContactChange& n : changes)
    {
        if (n.what == TouchChange::Begins)
            begin_loaded_touch(ctx, n.contact);
        else if (n.what == TouchChange::MayHit)
            wake_both(ctx, n.contact);
    }
    for (const ContactChange& n : changes)
    {
        if (n.what == TouchChange::Ends)
            end_touch(ctx.scene, n.contact, ctx.scene.events, 0);
    }
    ctx.scratch.broad.motion.resize(state.awake_bodies.size(), 0);         // bodies woken in this stage were at rest
    append_all(of_others, std::span(state.awake_contacts).subspan(count)); // woken in this stage
    links.ask_later(of_others);
    links.join();
    ctx.report.pairs = static_cast<int>(state.awake_contacts.size());
}

} // namespace carom::internal
