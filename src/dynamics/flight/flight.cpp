// A body in flight is not a pile. Its path is exact until it meets something (motion.cpp); when that will be is found on both true paths
// (next_event.cpp); the impact is resolved there, with all that touches at that moment (impact.cpp, reflect.cpp), and the rest of the
// sub-step is flown from there: no time is lost and no gap is left. What comes to rest is handed to the solver (landing.cpp).

#include "dynamics/flight.h"

#include "dynamics/contact_store.h"
#include "dynamics/flight/impact.h"
#include "dynamics/flight/landing.h"
#include "dynamics/flight/next_event.h"
#include "dynamics/flight/trace.h"

namespace carom::internal {

namespace {

// The first by time; of equals the first in the unit.
Flier* earliest(const FlightSpan& span)
{
    Flier* best = nullptr;
    for (Flier& f : span.fliers())
    {
        if (f.event_time <= span.h && (best == nullptr || f.event_time < best->event_time))
            best = &f;
    }
    return best;
}

// Others near a struck body of the solver's may now meet it sooner.
void reconsider_neighbours(const FlightSpan& span, std::int32_t struck)
{
    const int body = span.scratch.state_bodies[static_cast<std::size_t>(struck)];
    const SceneState& state = span.state;
    for (int edge = state.bodies[body].first_contact; edge != none; edge = state.contacts[edge >> 1].next[edge & 1])
    {
        if (Flier* f = span.flier_at(span.state_in_unit(other_body(state.contacts[edge >> 1], body))))
            find_next_event(span, *f);
    }
}

// What stays where it is looks for nothing: the others must see it there.
void reconsider_all(const FlightSpan& span)
{
    for (Flier& f : span.fliers())
        find_next_event(span, f);
}

void process(const FlightSpan& span, Flier& f)
{
    if (f.event_version != version_of(span, f.event_state))
    {
        find_next_event(span, f);
        return;
    }
    std::vector<std::int32_t> changed;
    resolve_impact(span, f, changed);
    for (const std::int32_t s : changed)
    {
        ++span.scratch.versions[static_cast<std::size_t>(s)];
        trace(span, s, f.time);
    }
    for (const std::int32_t s : changed)
    {
        if (Flier* flier = span.flier_at(s))
            is_capped(*flier) ? reconsider_all(span) : find_next_event(span, *flier);
        else
            reconsider_neighbours(span, s);
    }
}

} // namespace

void raise_fast(StepContext& ctx, const Unit& unit, int k, UnitOutput& output)
{
    if (unit.flier_count == 0)
        return;
    const FlightSpan span(ctx, unit, k, output);
    for (Flier& f : span.fliers())
    {
        const BodyState& s = span.state_of(f.state);
        const bool was_struck = unit.precise || f.crowded || f.deflected;
        if (f.landed && was_struck &&
            (is_fast(span, f, s.velocity.x, s.velocity.y, s.angular_velocity) || leaves_its_boxes(span, f)))
            take_off(span, f, span.h); // where the sub-step before has left it
    }
}

void trace_paths(StepContext& ctx, const Unit& unit, int k, UnitOutput& output)
{
    if (unit.traced)
        trace_all(FlightSpan(ctx, unit, k, output));
}

void advance_fliers(StepContext& ctx, const Unit& unit, int k, UnitOutput& output)
{
    if (unit.flier_count == 0)
        return;
    const FlightSpan span(ctx, unit, k, output);
    for (Flier& f : span.fliers())
        start_flight(span, f);
    trace_all(span);
    for (Flier& f : span.fliers())
        find_next_event(span, f);
    while (Flier* next = earliest(span))
        process(span, *next);
    for (Flier& f : span.fliers())
        finish_flight(span, f);
}

} // namespace carom::internal
