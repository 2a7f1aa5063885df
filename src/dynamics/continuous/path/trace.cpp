// Records the paths of bodies within a step.

#include "dynamics/continuous/path/trace.h"

#include "core/trigonometry.h"

namespace carom::internal {

namespace {

// A deflected body may meet triggers that are not near its predicted path.
bool is_recorded(const FlightSpan& span, std::int32_t state)
{
    const std::int32_t f = span.scratch.flight.flier_of_state[static_cast<std::size_t>(state)];
    return (span.state_of(state).flags & body_flag::traced) != 0 ||
           (f != none && span.scratch.flight.fliers[static_cast<std::size_t>(f)].is_deflected());
}

std::int32_t& last_piece_of(const FlightSpan& span, std::int32_t state)
{
    std::vector<std::int32_t>& last = span.output.last_piece;
    if (last.empty())
        last.assign(static_cast<std::size_t>(span.island.state_count), none);
    return last[static_cast<std::size_t>(state - span.island.first_state)];
}

FramePath at_rest(const BodySim& sim, Rotation rotation)
{
    FramePath path;
    path.local_center = sim.local_center;
    path.c = static_cast<double>(rotation.c);
    path.s = static_cast<double>(rotation.s);
    return path;
}

// The solver has moved the body to the end of the sub-step; its velocity may have changed since. The path leads from the end of the last
// piece to that pose, in a straight line or, in free flight, on a parabola.
FramePath solved_path(const FlightSpan& span, std::int32_t state, double time)
{
    const BodyState& s = span.state_of(state);
    const int body = span.scratch.solver.state_bodies[static_cast<std::size_t>(state)];
    const BodySim& sim = span.sim_of(body);
    const std::int32_t last = last_piece_of(span, state);
    FramePath path = at_rest(sim, rotation_at_start(span.ctx.state, body));
    if (last != none)
    {
        const PathPiece& piece = span.output.path[static_cast<std::size_t>(last)];
        const FramePath now = path_after(piece.path, span.time_of_step(time) - piece.start);
        const Rotation q{static_cast<float>(now.c), static_cast<float>(now.s)};
        const Vec2 arm = rotate(q, sim.local_center - now.local_center); // a hinge's pivot is not the center of mass
        path.center.x = now.center.x + static_cast<double>(arm.x);
        path.center.y = now.center.y + static_cast<double>(arm.y);
        path.c = now.c;
        path.s = now.s;
    }
    const double left = span.h - time;
    if (left <= 0)
        return path;
    const Rotation q = s.delta_rotation * sim.rotation;
    const auto c = static_cast<double>(q.c);
    const auto sine = static_cast<double>(q.s);
    const bool falls = (s.flags & body_flag::unbound) != 0;
    path.center.ax = falls ? static_cast<double>(span.constants_of(state).acceleration.x) : 0;
    path.center.ay = falls ? static_cast<double>(span.constants_of(state).acceleration.y) : 0;
    path.center.vx = (static_cast<double>(s.delta_position.x) - path.center.x) / left - 0.5 * left * path.center.ax;
    path.center.vy = (static_cast<double>(s.delta_position.y) - path.center.y) / left - 0.5 * left * path.center.ay;
    path.w = arc_tangent(sine * path.c - c * path.s, c * path.c + sine * path.s) / left;
    return path;
}

} // namespace

void trace(const FlightSpan& span, std::int32_t state, double time)
{
    if (!span.state.broad_phase.has_triggers() || !is_recorded(span, state))
        return;
    const int body = span.scratch.solver.state_bodies[static_cast<std::size_t>(state)];
    const FramePath path =
        span.flier_at(state) != nullptr ? path_from(span, body, time, span.sim_of(body).center) : solved_path(span, state, time);
    last_piece_of(span, state) = static_cast<std::int32_t>(span.output.path.size());
    span.output.path.push_back({body, 0, span.time_of_step(time), path});
}

void trace_all(const FlightSpan& span)
{
    if (span.island.traced)
    {
        for (int i = span.island.first_state; i < span.island.first_state + span.island.state_count; ++i)
            trace(span, i, 0);
        return;
    }
    for (const Flier& f : span.fliers())
        trace(span, f.state, 0);
}

} // namespace carom::internal
