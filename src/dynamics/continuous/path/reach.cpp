// Circles around the paths of a sub-step.

#include "dynamics/continuous/path/reach.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

double first_meeting(const Reach& a, const Reach& b)
{
    const double start = std::max(a.time, b.time);
    const double to_a = start - a.time;
    const double to_b = start - b.time;
    const double x = b.x + to_b * b.vx - a.x - to_a * a.vx;
    const double y = b.y + to_b * b.vy - a.y - to_a * a.vy;
    return start + first_meeting_of_circles(x, y, b.vx - a.vx, b.vy - a.vy, a.radius + b.radius);
}

namespace {

constexpr double margin = 1.001; // bodies that almost touch are considered

Reach reach_of_flier(const FlightSpan& span, const Flier& f, const BodySim& sim)
{
    const CenterMotion c = center_of(f);
    const double left = span.h - f.time;
    const double extent = margin * static_cast<double>(sim.extent);
    const Reach reach{sim.center.x + c.x, sim.center.y + c.y, 0, 0, f.time, extent};
    const double bend = left * left * (length_of(f.ax, f.ay) + std::fabs(f.alpha) * length_of(f.arm_x, f.arm_y));
    if (is_capped(span, f))
        return reach;
    if (f.arm_x != 0 || f.arm_y != 0) // the center circles about a pivot
        return {reach.x, reach.y, 0, 0, f.time, extent + left * length_of(c.vx, c.vy) + bend};
    return {reach.x, reach.y, c.vx, c.vy, f.time, extent + bend};
}

// The solver has already moved the body to the end of the sub-step.
Reach reach_of_solved(const FlightSpan& span, std::int32_t s, const BodySim& sim)
{
    const BodyState& there = span.state_of(s);
    const auto vx = static_cast<double>(there.velocity.x);
    const auto vy = static_cast<double>(there.velocity.y);
    const double bend = span.h * span.h * length_of(span.constants_of(s).acceleration.x, span.constants_of(s).acceleration.y);
    return {sim.center.x + static_cast<double>(there.delta_position.x) - span.h * vx,
            sim.center.y + static_cast<double>(there.delta_position.y) - span.h * vy,
            vx,
            vy,
            0,
            margin * static_cast<double>(sim.extent) + bend};
}

} // namespace

Reach reach_of(const FlightSpan& span, int body)
{
    const std::int32_t s = span.state_in_island(body);
    if (span.flier_at(s) != nullptr)
        return reach_in_list(span, span.scratch.flight.flier_of_state[static_cast<std::size_t>(s)]);
    return reach_of_solved(span, s, span.sim_of(body));
}

// One that has been capped since its reach was noted stays where it is.
Reach reach_in_list(const FlightSpan& span, std::int32_t flier)
{
    const Flier& f = span.scratch.flight.fliers[static_cast<std::size_t>(flier)];
    return !f.landed && is_capped(span, f) ? reach_of_flier(span, f, span.sim_of(f.body))
                                           : span.scratch.flight.reaches[static_cast<std::size_t>(flier)];
}

void find_reach(const FlightSpan& span, std::int32_t flier)
{
    const Flier& f = span.scratch.flight.fliers[static_cast<std::size_t>(flier)];
    const BodySim& sim = span.sim_of(f.body);
    span.scratch.flight.reaches[static_cast<std::size_t>(flier)] =
        f.landed ? reach_of_solved(span, f.state, sim) : reach_of_flier(span, f, sim);
}

} // namespace carom::internal
