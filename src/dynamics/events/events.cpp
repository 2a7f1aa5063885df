// Stage 7, events: sorts the spans, then runs the callbacks on copies of the events, so that callbacks may change anything.

#include "core/grow.h"
#include "core/task_pool.h"
#include "dynamics/stages.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <utility>

namespace carom::internal {

namespace {

template <class Event>
std::pair<ShapeId, ShapeId> shapes_of(const Event& event)
{
    return {event.shape_a, event.shape_b};
}

std::pair<ShapeId, ShapeId> shapes_of(const TriggerEvent& event) { return {event.trigger, event.visitor}; }

// Bits that compare as the values do.
std::uint32_t ordered_bits(float x)
{
    const auto bits = std::bit_cast<std::uint32_t>(x + 0.0f); // no -0
    return x < 0 ? ~bits : bits | 1u << 31;
}

// Slots suffice: in one step a slot stands for one shape.
template <class Event>
EventKey key_of(const Event& event, std::size_t place)
{
    const auto [first, second] = shapes_of(event);
    return {std::uint64_t{ordered_bits(event.time)} << 32 | first.slot, std::uint64_t{second.slot} << 32 | place};
}

// Permutes the events into the order of the keys, cycle by cycle. A key contains the index that its event comes from.
template <class Event>
void move_to_keys(std::vector<Event>& events, std::vector<EventKey>& keys)
{
    const auto place_of = [&](std::size_t i) { return std::size_t{static_cast<std::uint32_t>(keys[i].second_and_place)}; };
    for (std::size_t first = 0; first < events.size(); ++first)
    {
        const Event moved = events[first];
        std::size_t to = first;
        while (true)
        {
            const std::size_t from = place_of(to);
            keys[to].second_and_place = to; // done
            events[to] = from == first ? moved : events[from];
            if (from == first)
                break;
            to = from;
        }
    }
}

// Events are large, so their keys are sorted instead.
template <class Event>
void sort_events(std::vector<Event>& events, std::vector<EventKey>& keys)
{
    set_size(keys, events.size());
    for (std::size_t i = 0; i < events.size(); ++i)
        keys[i] = key_of(events[i], i);
    std::sort(keys.begin(), keys.end());
    move_to_keys(events, keys);
}

template <class Event>
void take_pending(std::vector<Event>& pending, std::vector<Event>& events)
{
    events.insert(events.begin(), pending.begin(), pending.end());
    pending.clear();
}

// --- callbacks -----------------------------------------------------------------------------------------------------------------------------

std::shared_ptr<const ShapeCallbacks> callbacks_of(const SceneData& scene, int shape)
{
    const auto slot = static_cast<std::size_t>(shape);
    return slot < scene.callbacks.size() ? scene.callbacks[slot] : nullptr;
}

// The callbacks of a shape that is still alive. The returned pointer keeps them, because a callback may replace or destroy them.
std::shared_ptr<const ShapeCallbacks> callbacks_of(const SceneData& scene, ShapeId id)
{
    const int slot = slot_of(id);
    return scene.state.shapes.is_live(slot, id.generation) ? callbacks_of(scene, slot) : nullptr;
}

template <class Event>
void turn_around(Event& event)
{
    std::swap(event.shape_a, event.shape_b);
    std::swap(event.body_a, event.body_b);
}

void mirror(ContactEndEvent& event) { turn_around(event); }

void mirror(ContactBeginEvent& event)
{
    turn_around(event);
    event.normal = -event.normal;
}

// Swapping the bodies reverses normal and tangent together; the friction impulse along the new tangent on the new b keeps its value.
void mirror(ImpactEvent& event)
{
    turn_around(event);
    event.normal = -event.normal;
    std::swap(event.speed_a, event.speed_b);
    event.speed_a = -event.speed_a;
    event.speed_b = -event.speed_b;
    std::swap(event.effective_mass_a, event.effective_mass_b);
    std::swap(event.velocity_a, event.velocity_b);
    std::swap(event.velocity_after_a, event.velocity_after_b);
}

template <class Event, class Callback>
void call_both(SceneData& scene, Scene& owner, const std::vector<Event>& events, Callback ShapeCallbacks::* which)
{
    for (const Event& event : events)
    {
        if (const auto callbacks = callbacks_of(scene, event.shape_a); callbacks && (*callbacks).*which)
            ((*callbacks).*which)(owner, event);
        if (const auto callbacks = callbacks_of(scene, event.shape_b); callbacks && (*callbacks).*which)
        {
            Event mirrored = event;
            mirror(mirrored);
            ((*callbacks).*which)(owner, mirrored);
        }
    }
}

using TriggerCallback = Function<void(Scene&, const TriggerEvent&)>;

void call_trigger(SceneData& scene, Scene& owner, const std::vector<TriggerEvent>& events,
                  TriggerCallback ShapeCallbacks::* which)
{
    for (const TriggerEvent& event : events)
    {
        for (const ShapeId id : {event.trigger, event.visitor})
        {
            if (const auto callbacks = callbacks_of(scene, id); callbacks && (*callbacks).*which)
                ((*callbacks).*which)(owner, event);
        }
    }
}

std::vector<TriggerEvent> inside_events(const SceneData& scene)
{
    std::vector<TriggerEvent> events;
    const SceneState& state = scene.state;
    const auto listens = [&](int shape)
    {
        const auto callbacks = callbacks_of(scene, state.shapes[shape].owner);
        return callbacks && callbacks->on_trigger_inside;
    };
    for (const std::int32_t index : state.trigger_contacts)
    {
        const Contact& c = state.contacts[index];
        if (touches(c) && (listens(c.shape_a) || listens(c.shape_b)))
            events.push_back(event_between<TriggerEvent>(state, c.shape_a, c.shape_b));
    }
    std::vector<EventKey> keys;
    sort_events(events, keys);
    return events;
}

} // namespace

void publish_events(StepContext& ctx)
{
    Events& events = ctx.scene.events;
    auto& [of_impacts, of_others] = ctx.scene.event_keys;
    run_both(
        ctx.scene.def.tasks, [&] { sort_events(events.impacts, of_impacts); },
        [&]
        {
            sort_events(events.begins, of_others);
            sort_events(events.ends, of_others);
            sort_events(events.enters, of_others);
            sort_events(events.exits, of_others);
        });
    // Events of contacts that user calls ended between the steps come first, in the order in which they happened.
    take_pending(ctx.scene.pending.ends, events.ends);
    take_pending(ctx.scene.pending.exits, events.exits);
}

void run_callbacks(SceneData& scene, Scene& owner)
{
    if (scene.callback_count == 0)
        return;
    const Events events = scene.events;
    call_both(scene, owner, events.begins, &ShapeCallbacks::on_contact_begin);
    call_both(scene, owner, events.impacts, &ShapeCallbacks::on_impact);
    call_both(scene, owner, events.ends, &ShapeCallbacks::on_contact_end);
    call_trigger(scene, owner, events.enters, &ShapeCallbacks::on_trigger_enter);
    call_trigger(scene, owner, inside_events(scene), &ShapeCallbacks::on_trigger_inside);
    call_trigger(scene, owner, events.exits, &ShapeCallbacks::on_trigger_exit);
}

} // namespace carom::internal
