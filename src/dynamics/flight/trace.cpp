#include "dynamics/flight/trace.h"

namespace carom::internal {

namespace {

// What was thrown off its way may meet triggers that nobody expected it at.
bool is_recorded(const FlightSpan& span, std::int32_t state)
{
    const Flier* f = span.flier_at(state);
    return (span.state_of(state).flags & body_flag::traced) != 0 || (f != nullptr && f->deflected);
}

} // namespace

void trace(const FlightSpan& span, std::int32_t state, double time)
{
    if (!is_recorded(span, state))
        return;
    const int body = span.scratch.state_bodies[static_cast<std::size_t>(state)];
    span.output.path.push_back({body, 0, span.time_of_step(time), path_from(span, body, time, span.sim_of(body).center)});
}

void trace_all(const FlightSpan& span)
{
    if (span.unit.traced)
    {
        for (int i = span.unit.first_state; i < span.unit.first_state + span.unit.state_count; ++i)
            trace(span, i, 0);
        return;
    }
    for (const Flier& f : span.fliers())
        trace(span, f.state, 0);
}

} // namespace carom::internal
