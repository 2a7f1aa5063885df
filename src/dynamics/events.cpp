// Stage 7, events: sorted spans, then callbacks from copies of the events, so that callbacks may change anything.

#include "dynamics/contact_store.h"
#include "dynamics/stages.h"

#include <algorithm>
#include <memory>
#include <tuple>

namespace carom::internal {

namespace {

template <class Event>
void sort_events(std::vector<Event>& events)
{
    // Stable: events of one pair at one time keep the order in which they happened.
    std::stable_sort(events.begin(), events.end(), [](const Event& x, const Event& y)
                     { return std::tie(x.time, x.shape_a, x.shape_b) < std::tie(y.time, y.shape_a, y.shape_b); });
}

void sort_triggers(std::vector<TriggerEvent>& events)
{
    std::stable_sort(events.begin(), events.end(), [](const TriggerEvent& x, const TriggerEvent& y)
                     { return std::tie(x.time, x.trigger, x.visitor) < std::tie(y.time, y.trigger, y.visitor); });
}

template <class Event>
void take_pending(std::vector<Event>& pending, std::vector<Event>& events)
{
    events.insert(events.begin(), pending.begin(), pending.end());
    pending.clear();
}

// --- callbacks -----------------------------------------------------------------------------------------------------------------------------

// The callbacks of a shape that still lives, held: the callback may replace or destroy them.
std::shared_ptr<const ShapeCallbacks> callbacks_of(const SceneData& scene, ShapeId id)
{
    const int slot = static_cast<int>(id.slot) - 1;
    if (!scene.state.shapes.is_live(slot, id.generation))
        return nullptr;
    return scene.shape_extras[static_cast<std::size_t>(slot)].callbacks;
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

// Swapping the bodies turns normal and tangent around together; the friction impulse along the new tangent on the new b keeps its value.
void mirror(ImpactEvent& event)
{
    turn_around(event);
    event.normal = -event.normal;
    std::swap(event.speed_a, event.speed_b);
    event.speed_a = -event.speed_a;
    event.speed_b = -event.speed_b;
    std::swap(event.effective_mass_a, event.effective_mass_b);
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

using TriggerCallback = std::function<void(Scene&, const TriggerEvent&)>;

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
        const auto& callbacks = scene.shape_extras[static_cast<std::size_t>(state.shapes[shape].owner)].callbacks;
        return callbacks && callbacks->on_trigger_inside;
    };
    for (const std::int32_t index : state.trigger_contacts)
    {
        const Contact& c = state.contacts[index];
        if ((c.flags & contact_flag::touching) != 0 && (listens(c.shape_a) || listens(c.shape_b)))
            events.push_back(
                {shape_id(state, c.shape_a), shape_id(state, c.shape_b), body_id(state, c.body_a), body_id(state, c.body_b), 0});
    }
    sort_triggers(events);
    return events;
}

} // namespace

void publish_events(StepContext& ctx)
{
    Events& events = ctx.scene.events;
    sort_events(events.begins);
    sort_events(events.ends);
    sort_events(events.impacts);
    sort_triggers(events.enters);
    sort_triggers(events.exits);
    // What user verbs ended between the steps comes first, in the order in which it happened.
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
