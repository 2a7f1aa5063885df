// Symplectic Euler steps of an island's bodies: velocities from forces, then positions from velocities.

#include "dynamics/solver/integrate.h"

#include "core/float4.h"
#include "core/index.h"
#include "dynamics/solver/simd/kernels.h"
#include "dynamics/state/turns.h"

#include <algorithm>
#include <cstddef>

namespace carom::internal {

namespace {

constexpr int enough_states = 256; // to share among threads

template <class Work>
void over_ranges(const SolvedIsland& work, const Work& of_range)
{
    const int first_state = work.island.first_state;
    work.team.share(work.island.state_count, enough_states,
                    [&](int first, int last) { of_range(first_state + first, first_state + last); });
}

// True for bodies that are neither kinematic nor in flight.
bool solver_moves(const BodyState& s) { return (s.flags & (body_flag::dynamic | body_flag::flier)) == body_flag::dynamic; }

static_assert(sizeof(BodySpeeds) == sizeof(F4) && offsetof(BodyState, angular_velocity) == 8);

// Velocity, angular velocity, and 0 in place of the flags.
F4 speeds_of(const BodyState& s) { return with_last(load4(&s.velocity.x), F4{}); }

void set_speeds(BodyState& s, F4 speeds) { store4(&s.velocity.x, with_last(speeds, load4(&s.velocity.x))); }

// Applies a sub-step's forces and damping: v + h a, then the decay.
F4 accelerated(const BodyState& s, const StateConstants& c, float h)
{
    static_assert(offsetof(StateConstants, angular_acceleration) == 12 && offsetof(StateConstants, acceleration) == 16);
    const F4 rest = load4(&c.acceleration.x); // acceleration, and both decays
    const F4 masses = load4(&c.inverse_mass.x);
    const F4 acceleration = low_and_high(rest, interleaved_high(masses, masses));
    const F4 decay = interleaved_high(rest, rest);
    return decay * (speeds_of(s) + h * acceleration);
}

void integrate_position(const SolvedIsland& work, int i)
{
    BodyState& s = work.view.states[i];
    if ((s.flags & body_flag::flier) != 0)
        return;
    s.delta_position += drift(work.view, i);
    if (s.angular_velocity != 0)
        turn_by(s, work.ctx.h * s.angular_velocity);
}

} // namespace

void integrate_velocities(const SolvedIsland& work, WarmStart start)
{
    over_ranges(work,
                [&](int first, int last)
                {
                    for (int i = first; i < last; ++i)
                    {
                        BodyState& s = work.view.states[i];
                        const F4 now = speeds_of(s);
                        store4(&work.scratch.solver.speeds[as_index(i)].velocity.x, now);
                        if (!solver_moves(s))
                            continue;
                        float* const unpushed = &work.scratch.solver.unpushed[as_index(i)].velocity.x;
                        const F4 next = accelerated(s, work.view.constants[i], work.ctx.h);
                        set_speeds(s, start == WarmStart::ByBody ? next + (now - load4(unpushed)) : next);
                        if (start != WarmStart::ByConstraint)
                            store4(unpushed, next);
                    }
                });
}

void integrate_positions(const SolvedIsland& work)
{
    over_ranges(work, [&](int first, int last) { integrate_positions(work, first, last); });
}

void integrate_positions(const SolvedIsland& work, int first, int last)
{
    while (first < last)
    {
        first += wide_kernels().move(work.view.states + first, work.view.constants + first, last - first, work.ctx.h);
        const int next = std::min(first + lane_count, last);
        for (; first < next; ++first)
            integrate_position(work, first);
    }
}

} // namespace carom::internal
