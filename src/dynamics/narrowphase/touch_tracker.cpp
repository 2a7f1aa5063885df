// Begins and ends of touches, and their events.

#include "dynamics/narrowphase/touch_tracker.h"

#include "core/grow.h"
#include "core/task_pool.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/state/contact_store.h"

#include <vector>

namespace carom::internal {

namespace {

constexpr std::size_t events_per_task = 512;
constexpr std::size_t touches_per_task = 64;

ContactBeginEvent begin_event(const SceneState& state, const Contact& contact)
{
    const Position point = state.sims[static_cast<std::size_t>(contact.body_a)].center + contact.manifold.points[0].anchor_a;
    return event_of<ContactBeginEvent>(state, contact, point, contact.manifold.normal);
}

template <class Event, class MakeEvent>
void report_noted(StepContext& ctx, std::span<const std::int32_t> contacts, std::vector<Event>& events,
                  const MakeEvent& make_event)
{
    const std::size_t first = events.size();
    set_size(events, first + contacts.size());
    for_each_in_chunks(ctx.scene.def.tasks, contacts.size(), events_per_task,
                       [&](std::size_t i) { events[first + i] = make_event(ctx.state, ctx.state.contacts[contacts[i]]); });
    ctx.state.graph_dirty |= !contacts.empty();
}

// For a contact that has touched within the step: when the step ends, it neither bears a load nor touches.
bool has_bounced(const StepContext& ctx, const Contact& contact)
{
    if ((contact.flags & contact_flag::loaded) != 0)
        return false;
    const Manifold m = world_manifold(ctx.state, contact, pose_at_start(ctx.state, contact.body_a),
                                      pose_at_start(ctx.state, contact.body_b), 2 * ctx.scene.tolerances.slop);
    return m.count == 0;
}

// Flags by index in `begins`, found on all threads.
std::span<const std::uint8_t> find_bounces(StepContext& ctx, std::span<const RawTouch> begins)
{
    const SceneState& state = ctx.state;
    std::vector<std::uint8_t>& bounced = ctx.scratch.narrow.bounced;
    set_size(bounced, begins.size());
    for_each_in_chunks(
        ctx.scene.def.tasks, begins.size(), touches_per_task, [&](std::size_t i)
        { bounced[i] = begins[i].contact != none && has_bounced(ctx, state.contacts[begins[i].contact]) ? 1 : 0; });
    return bounced;
}

} // namespace

bool touches_elsewhere(const SceneState& state, int index)
{
    const Contact& contact = state.contacts[index];
    if ((contact.flags & contact_flag::piece) == 0)
        return false;
    const int owner_a = state.shapes[contact.shape_a].owner;
    const int owner_b = state.shapes[contact.shape_b].owner;
    // In the collision table, lines come before the shapes that touch them, arcs after.
    const auto is_same = [&](const Contact& other)
    {
        const int a = state.shapes[other.shape_a].owner;
        const int b = state.shapes[other.shape_b].owner;
        return (a == owner_a && b == owner_b) || (a == owner_b && b == owner_a);
    };
    // The body without the chain has the shorter list.
    const int body = owner_a == contact.shape_a ? contact.body_a : contact.body_b;
    for (const int i : contacts_of(state, body))
    {
        const Contact& other = state.contacts[i];
        if (i != index && (other.flags & (contact_flag::touching | contact_flag::begun)) == contact_flag::touching &&
            is_same(other))
            return true;
    }
    return false;
}

void begin_touch(SceneData& scene, int index)
{
    SceneState& state = scene.state;
    Contact& contact = state.contacts[index];
    note_begin(contact);
    state.graph_dirty = true;
    if (!touches_elsewhere(state, index))
        append(scene.events.begins, begin_event(state, contact));
}

void end_touch(SceneData& scene, int index, Events& events, float time)
{
    SceneState& state = scene.state;
    Contact& contact = state.contacts[index];
    if (!touches(contact))
        return;
    note_end(contact);
    const bool is_trigger = (contact.flags & contact_flag::trigger) != 0;
    state.graph_dirty |= !is_trigger;
    if (touches_elsewhere(state, index))
        return;
    if (is_trigger)
        append(events.exits, event_between<TriggerEvent>(state, contact.shape_a, contact.shape_b, time));
    else
        append(events.ends, event_between<ContactEndEvent>(state, contact.shape_a, contact.shape_b, time));
}

void report_noted_begins(StepContext& ctx, std::span<const std::int32_t> contacts)
{
    report_noted(ctx, contacts, ctx.scene.events.begins, begin_event);
}

void report_noted_ends(StepContext& ctx, std::span<const std::int32_t> contacts)
{
    report_noted(ctx, contacts, ctx.scene.events.ends,
                 [](const SceneState& state, const Contact& contact) { return event_of<ContactEndEvent>(state, contact, 0.0f); });
}

void begin_touch_within_step(SceneState& state, ImpactReport& report, const RawTouch& touch)
{
    append(report.begins, touch);
    if (touch.contact != none)
        state.contacts[touch.contact].flags |= contact_flag::touching | contact_flag::begun;
}

void report_begins(StepContext& ctx, const IslandOutput& output)
{
    SceneState& state = ctx.state;
    for (const RawTouch& t : output.begins)
    {
        state.graph_dirty = true;
        if (t.contact != none)
        { // the first piece of a chain that touches begins the touch for all pieces
            const bool known = touches_elsewhere(state, t.contact);
            state.contacts[t.contact].flags &= ~contact_flag::begun;
            if (known)
                continue;
        }
        append(ctx.scene.events.begins, event_between<ContactBeginEvent>(state, t.shape_a, t.shape_b, t.point, t.normal, t.time));
    }
}

void end_bounces(StepContext& ctx, const IslandOutput& output)
{
    const std::span<const std::uint8_t> bounced = find_bounces(ctx, output.begins);
    for (std::size_t i = 0; i < bounced.size(); ++i)
    {
        const RawTouch& touch = output.begins[i];
        if (touch.contact == none)
            append(ctx.scene.events.ends, event_between<ContactEndEvent>(ctx.state, touch.shape_a, touch.shape_b, touch.time));
        if (bounced[i] == 0)
            continue;
        end_touch(ctx.scene, touch.contact, ctx.scene.events, ctx.dt);
        leave_lane(ctx.state, touch.contact); // the lane assumes that the touch is reported
    }
}

} // namespace carom::internal
