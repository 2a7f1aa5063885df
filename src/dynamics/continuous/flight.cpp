// Bodies in flight, impact by impact. The path of a flier is exact until it meets something (motion.cpp). The time of impact is found on
// both true paths (next_impact.cpp), and the impact is resolved there with all contacts of that moment (impact.cpp, reflect.cpp). The rest
// of the sub-step is flown from there: no time is lost and no gap is left. A body that comes to rest is handed to the solver (landing.cpp).

#include "dynamics/continuous/flight.h"

#include "core/tournament.h"
#include "dynamics/continuous/impact/impact.h"
#include "dynamics/continuous/landing.h"
#include "dynamics/continuous/next_impact.h"
#include "dynamics/continuous/path/trace.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <atomic>
#include <span>

namespace carom::internal {

namespace {

// The flier with the earliest event; null: nothing happens any more.
Flier* earliest(const FlightSpan& span)
{
    const Tournament events = events_of(span);
    const std::size_t first = events.first();
    return events.time(first) > span.h ? nullptr : &span.fliers()[first];
}

// Deflected bodies follow new paths, so their reaches change. All are found before the first is set, which may look at all that have been deflected.
void note_reaches(const FlightSpan& span, std::span<const std::int32_t> states)
{
    FlightWorkspace& flight = span.scratch.flight;
    const auto flier_of = [&](std::int32_t state) { return flight.flier_of_state[static_cast<std::size_t>(state)]; };
    for (const std::int32_t s : states)
    {
        if (flier_of(s) != none)
            find_reach(span, flier_of(s));
    }
    for (const std::int32_t s : states)
    {
        if (flier_of(s) == none)
            continue;
        const Flier& f = flight.fliers[static_cast<std::size_t>(flier_of(s))];
        if (f.is_deflected())
            span.output.deflected.set(f.deflected_index, flight.reaches);
    }
}

// Fliers near a struck solver-owned body may now meet it sooner. Between two bodies of one shape each, only their contact is searched
// again. A flier whose own path has changed searches for itself.
void reconsider_neighbours(const FlightSpan& span, std::int32_t struck, std::span<const std::int32_t> changed)
{
    const int body = span.scratch.solver.state_bodies[static_cast<std::size_t>(struck)];
    const SceneState& state = span.state;
    const auto has_one_shape = [&](int b) { return state.bodies[b].first_shape == state.bodies[b].last_shape; };
    for (const int index : contacts_of(state, body))
    {
        Flier* f = span.flier_at(span.state_in_island(other_body(state.contacts[index], body)));
        if (f != nullptr && std::ranges::find(changed, f->state) == changed.end())
            has_one_shape(body) && has_one_shape(f->body) ? reconsider(span, *f, struck, index) : find_next_event(span, *f);
    }
}

// A capped flier stays where it is and does not search: fliers that may come there must find it.
void reconsider_those_near(const FlightSpan& span, const Flier& capped)
{
    const Reach place = reach_of(span, capped.body);
    for (Flier& f : span.fliers())
    {
        if (!f.landed && first_meeting(reach_of(span, f.body), place) <= span.h)
            find_next_event(span, f);
    }
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
        ++span.scratch.flight.versions[static_cast<std::size_t>(s)];
        trace(span, s, f.time);
    }
    note_reaches(span, changed);
    for (const std::int32_t s : changed)
    {
        if (Flier* flier = span.flier_at(s))
            is_capped(span, *flier) ? reconsider_those_near(span, *flier) : find_next_event(span, *flier);
        else
            reconsider_neighbours(span, s, changed);
    }
}

void note_all_reaches(const FlightSpan& span)
{
    for (std::int32_t f = span.island.first_flier; f < span.island.first_flier + span.island.flier_count; ++f)
    {
        const Flier& flier = span.scratch.flight.fliers[static_cast<std::size_t>(f)];
        if (!flier.landed || flier.is_deflected())
            find_reach(span, f);
    }
    span.output.deflected.set_all(span.h, span.scratch.flight.reaches);
}

// Budget per sub-step, in solved rows; bodies whose impacts exceed it stay where they are until the next sub-step. It amounts to some
// milliseconds; impacts that converge take a hundredth of it.
constexpr std::int64_t work_of_island = 20'000;
constexpr std::int64_t work_of_flier = 500;

constexpr std::int64_t looks_of_island = 200'000; // sixteen times the need of scenes and experiments
constexpr std::int64_t looks_of_flier = 100;

constexpr int fliers_per_share = 16;
constexpr int enough_fliers = 32; // enough to share among workers

// The budget of looks is spent: a flier with an event left stays where it is until the next sub-step, and so does a flier that would come
// there. All of them stop at the time up to which every event is known: none has met another by then.
void stop_who_would_meet(const FlightSpan& span)
{
    const Flier* next = earliest(span);
    if (next == nullptr)
        return;
    const double now = next->event_time;
    std::vector<Flier*> moving;
    std::vector<Flier*> stopped;
    for (Flier& f : span.fliers())
    {
        if (!f.landed && !is_capped(span, f))
            (f.event_time <= span.h ? stopped : moving).push_back(&f);
    }
    for (std::size_t i = 0; i < stopped.size(); ++i)
    {
        Flier& f = *stopped[i];
        advance(span, f, now);
        f.impacts = span.most_impacts;
        trace(span, f.state, now);
        const Reach place = reach_of(span, f.body);
        const auto passes = [&](const Flier* other) { return first_meeting(reach_of(span, other->body), place) > span.h; };
        const auto meets = std::stable_partition(moving.begin(), moving.end(), passes);
        stopped.insert(stopped.end(), meets, moving.end());
        moving.erase(meets, moving.end());
    }
    span.output.capped = true;
}

// Before the first event the searches are independent of each other.
void find_first_events(const FlightSpan& span, WorkerTeam& team)
{
    const std::span<Flier> fliers = span.fliers();
    const auto count = static_cast<int>(fliers.size());
    const auto look = [&](int first, int last)
    {
        for (int i = first; i < std::min(last, count); ++i)
            static_cast<void>(try_find_next_event(span, fliers[static_cast<std::size_t>(i)]));
    };
    if (count < enough_fliers)
    {
        look(0, count);
        return;
    }
    std::atomic<int> next{0}; // searches differ widely in cost
    team.in_parts(
        [&](int, int)
        {
            for (int first = 0; (first = next.fetch_add(fliers_per_share)) < count;)
                look(first, first + fliers_per_share);
        });
}

// From the first events on, one after the other.
void follow_events(const FlightSpan& span)
{
    events_of(span).start();
    for (Flier& f : span.fliers())
    {
        if (f.passes == none)
            continue;
        span.state.contacts[f.passes].flags |= contact_flag::passing;
        find_next_event(span, f);
    }
    for (Flier& f : span.fliers())
        f.looks = f.union_looks = 0; // the first searches cannot be left out, so they are not charged
    while (Flier* next = span.output.looks_left > 0 ? earliest(span) : nullptr)
        process(span, *next);
    stop_who_would_meet(span);
    for (Flier& f : span.fliers())
        finish_flight(span, f);
}

} // namespace

void note_deflected(Scratch& scratch, IslandOutput& output, std::int32_t flier)
{
    Flier& f = scratch.flight.fliers[static_cast<std::size_t>(flier)];
    if (f.is_deflected())
        return;
    f.deflected_index = output.deflected.add(flier);
}

namespace {

// The flier takes off together with a bat (a hinged body) that presses it: without the ball in its path the solver would swing the bat through.
void take_off_with_bats(const FlightSpan& span, Flier& f)
{
    std::vector<Flier*> bats;
    for_each_pressed_by(span, f.state,
                        [&](std::int32_t other)
                        {
                            const std::int32_t i = span.scratch.flight.flier_of_state[static_cast<std::size_t>(other)];
                            if (i == none)
                                return;
                            Flier& bat = span.scratch.flight.fliers[static_cast<std::size_t>(i)];
                            if (bat.landed && bat.joint != none)
                                bats.push_back(&bat);
                        });
    take_off(span, f, span.h); // from where the previous sub-step has left it
    for (Flier* bat : bats)
    {
        if (bat->landed)
            take_off(span, *bat, span.h);
    }
}

} // namespace

void take_off_fast_movers(StepContext& ctx, const Island& island, int k, IslandOutput& output)
{
    if (island.flier_count == 0)
        return;
    const FlightSpan span(ctx, island, k, output);
    for (Flier& f : span.fliers())
    {
        const BodyState& s = span.state_of(f.state);
        const bool was_struck = island.policy.exact_impacts || f.needs_wall_check || f.is_deflected();
        if (f.landed && was_struck &&
            (is_fast(span, f, s.velocity.x, s.velocity.y, s.angular_velocity) || leaves_its_boxes(span, f)))
            take_off_with_bats(span, f);
    }
}

namespace {

// True if all bodies of the island are in free flight and each path through the step is a single parabola.
bool flies_freely(const StepContext& ctx, const Island& island)
{
    const bool alike = island.flier_count == island.dynamic_count && island.constraint_count == 0 && island.wide_count == 0 &&
                       island.joint_count == 0 && island.wide_joint_count == 0 && island.law_count == 0 &&
                       island.policy.subdivisions == 1;
    if (!alike || island.traced || ctx.scene.def.record_substeps)
        return false;
    const auto falls = [&](const Flier& f)
    {
        const StateConstants& c = ctx.scratch.solver.constants[static_cast<std::size_t>(f.state)];
        return !f.landed && f.joint == none && c.linear_decay == 1 && c.angular_decay == 1;
    };
    return std::ranges::all_of(fliers_of(ctx.scratch, island), falls);
}

constexpr int dense = 2; // where more than one body of two meets something, most predictions for a whole step come to nothing

// Without acceleration, impacts do not depend on the length of the sub-step.
bool moves_evenly(const Flier& f) { return f.ax == 0 && f.ay == 0 && f.alpha == 0; }

} // namespace

namespace {

// Subdivisions of a sub-step share its budget. Once the first ones have spent it, each later one still gets its part of the same amount.
void share_budget(const StepContext& ctx, const Island& island, int k, IslandOutput& output)
{
    const bool starts = k % ctx.subdivisions == 0;
    const int substeps = substeps_in(ctx);
    const std::int64_t work = substeps * (work_of_island + work_of_flier * island.flier_count);
    const std::int64_t looks = substeps * (looks_of_island + looks_of_flier * island.flier_count);
    const std::int64_t work_left = starts ? work : std::max(output.impact_work.left, work / ctx.subdivisions);
    output.impact_work = {.left = work_left, .whole = work_left};
    output.looks_left = starts ? looks : std::max(output.looks_left, looks / ctx.subdivisions);
}

} // namespace

bool fly_whole_step(const StepContext& ctx, const Island& island, IslandOutput& output, WorkerTeam& team)
{
    if (!flies_freely(ctx, island))
        return false;
    StepContext whole = ctx;
    whole.h = ctx.dt;
    whole.substeps = 1;
    const FlightSpan span(whole, island, 0, output);
    for (Flier& f : span.fliers())
        start_flight(span, f);
    note_all_reaches(span);
    find_first_events(span, team);
    const bool may_meet = std::ranges::all_of(span.fliers(), moves_evenly);
    const auto meets = [&](const Flier& f) { return f.passes != none || f.event_time <= span.h; };
    if (std::ranges::count_if(span.fliers(), meets) > (may_meet ? island.flier_count / dense : 0))
        return false;
    share_budget(whole, island, 0, output);
    output.struck_states.clear();
    follow_events(span);
    return true;
}

void trace_paths(StepContext& ctx, const Island& island, int k, IslandOutput& output)
{
    if (island.traced)
        trace_all(FlightSpan(ctx, island, k, output));
}

void advance_fliers(StepContext& ctx, const Island& island, int k, IslandOutput& output, WorkerTeam& team)
{
    if (island.flier_count == 0)
        return;
    const FlightSpan span(ctx, island, k, output);
    share_budget(ctx, island, k, output);
    output.struck_states.clear();
    for (Flier& f : span.fliers())
        start_flight(span, f);
    trace_all(span);
    note_all_reaches(span);
    find_first_events(span, team);
    follow_events(span);
}

} // namespace carom::internal
