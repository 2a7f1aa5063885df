#include "dynamics/flight/trace.h"

namespace carom::internal {

void trace(const FlightSpan& span, std::int32_t state, double time)
{
    if ((span.state_of(state).flags & body_flag::traced) == 0)
        return;
    const int body = span.scratch.state_bodies[static_cast<std::size_t>(state)];
    span.output.path.push_back({body, 0, span.time_of_step(time), path_from(span, body, time, span.sim_of(body).center)});
}

void trace_all(const FlightSpan& span)
{
    if (!span.unit.traced)
        return;
    for (int i = span.unit.first_state; i < span.unit.first_state + span.unit.state_count; ++i)
        trace(span, i, 0);
}

} // namespace carom::internal
