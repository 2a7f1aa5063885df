#include "dynamics/solver/bounce/bounce_limit.h"

#include "core/as_double.h"
#include "core/index.h"
#include "dynamics/solver/joint/direct/direct_solver.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

constexpr float most_turn = 0.5f; // rad

double times_mass(float product, float inverse_mass)
{
    return inverse_mass > 0 ? as_double(product) / as_double(inverse_mass) : 0;
}

double product(const StateConstants& c, const BodySpeeds& u, const BodySpeeds& v)
{
    return times_mass(u.velocity.x * v.velocity.x, c.inverse_mass.x) + times_mass(u.velocity.y * v.velocity.y, c.inverse_mass.y) +
           times_mass(u.angular_velocity * v.angular_velocity, c.inverse_inertia);
}

BodySpeeds now_of(const BodyState& s) { return {s.velocity, s.angular_velocity}; }

BodySpeeds change(const BodyState& to, const BodySpeeds& from)
{
    return {to.velocity - from.velocity, to.angular_velocity - from.angular_velocity};
}

// The share of the bounce after which no joined body turns farther in a sub-step than its joints can follow, unless it did before.
float share_of_turns(const SolverView& view, const Island& island, std::span<const BodySpeeds> stopped)
{
    float share = 1;
    for (int i = island.first_state + 1; i <= island.first_state + island.dynamic_count; ++i)
    {
        const BodyState& s = view.states[i];
        const float before = std::fabs(stopped[as_index(i - island.first_state)].angular_velocity);
        const float most = std::max(most_turn * view.inverse_h, before);
        const float now = std::fabs(s.angular_velocity);
        if ((s.flags & body_flag::jointed) != 0 && now > most)
            share = std::min(share, (most - before) / (now - before));
    }
    return share;
}

} // namespace

double kinetic_energy(const SolverView& view, const Island& island)
{
    double sum = 0;
    for (int i = island.first_state + 1; i <= island.first_state + island.dynamic_count; ++i)
        sum += 0.5 * product(view.constants[i], now_of(view.states[i]), now_of(view.states[i]));
    return sum;
}

void take_speeds(const SolverView& view, const Island& island, std::vector<BodySpeeds>& out)
{
    out.clear();
    for (int i = island.first_state; i < island.first_state + island.state_count; ++i)
        out.push_back(now_of(view.states[i]));
}

// With the change d of the speeds v and its share s: v·v + 2 s v·d + s² d·d = 2 most, products taken with the masses.
void limit_bounce(const SolverView& view, const Island& island, std::span<const ContactBounce> bounces,
                  std::span<const BodySpeeds> stopped, double most)
{
    double vv = 0;
    double vd = 0;
    double dd = 0;
    const auto stopped_at = [&](int i) { return stopped[as_index(i - island.first_state)]; };
    for (int i = island.first_state + 1; i <= island.first_state + island.dynamic_count; ++i)
    {
        const BodySpeeds d = change(view.states[i], stopped_at(i));
        vv += product(view.constants[i], stopped_at(i), stopped_at(i));
        vd += product(view.constants[i], stopped_at(i), d);
        dd += product(view.constants[i], d, d);
    }
    float share = share_of_turns(view, island, stopped);
    if (vv + 2 * vd + dd > 2 * most && dd > 0)
    {
        const double left = std::max(2 * most - vv, 0.0);
        share = std::min(share, static_cast<float>((std::sqrt(vd * vd + dd * left) - vd) / dd));
    }
    if (share == 1)
        return;
    for (int i = island.first_state + 1; i <= island.first_state + island.dynamic_count; ++i)
    {
        BodyState& s = view.states[i];
        const BodySpeeds d = change(s, stopped_at(i));
        s.velocity = stopped_at(i).velocity + share * d.velocity;
        s.angular_velocity = stopped_at(i).angular_velocity + share * d.angular_velocity;
    }
    for (const ContactBounce& bounce : bounces)
    {
        for (int i = 0; i < bounce.constraint->count; ++i)
        {
            float& impulse = bounce.constraint->points[i].normal_impulse;
            impulse = bounce.stopped[i] + share * (impulse - bounce.stopped[i]);
        }
    }
}

} // namespace carom::internal
