// The part of IslandEnergy that scales speeds to the energy that loads leave.

#include "core/as_double.h"
#include "dynamics/solver/energy/island_energy.h"
#include "dynamics/state/turns.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

constexpr double energy_rounding = 2e-6;    // of the energy, over a whole sub-step
constexpr double noise_displacement = 0.05; // of the slop, per sub-step: this far against the forces nothing is gained
constexpr double rest_displacement = 0.004; // the same for bodies without energy: they may not creep

bool decays(const StateConstants& c) { return c.linear_decay != 1 || c.angular_decay != 1; }

} // namespace

void IslandEnergy::restore(bool exact)
{
    if (m_all_driven)
        return;
    add_work();
    add_kinetic(-1);
    add_springs(-1);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        Group& group = group_of(i);
        group.missing += body(i).missing;
        group.first += body(i).first;
        group.work += body(i).work;
        if (group.touches)
            group.slop_work += as_double(m_slop) / m_subdivisions * force_on(i);
        group.is_passive &= !decays(m_view.constants[i]) && !flies(i) && !(group.is_carried && group.is_anchored);
        group.is_passive &= !group.is_carried || (body(i).mass_x > 0 && body(i).mass_x == body(i).mass_y);
    }
    for (int g = 0; g < m_count; ++g)
    {
        const Group& group = m_groups[static_cast<std::size_t>(g)];
        if (group.is_joined && group.is_passive)
            scale(g, exact && !group.may_lose);
    }
}

double IslandEnergy::force_on(std::int32_t state)
{
    const Vec2 a = m_view.constants[state].acceleration;
    return std::sqrt(square(body(state).mass_x * as_double(a.x)) + square(body(state).mass_y * as_double(a.y)));
}

IslandEnergy::Drift IslandEnergy::drift_of(int index)
{
    Drift drift;
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (body(i).group == index)
            drift.add(body(i), m_view.states[i], place_of(i));
    }
    drift.center();
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (body(i).group == index)
            drift.add_spin(body(i), m_view.states[i], place_of(i));
    }
    return drift;
}

IslandEnergy::Arm IslandEnergy::place_of(std::int32_t state)
{
    const Arm& center = body(state).center;
    const Vec2 displacement = m_view.states[state].delta_position;
    return {center.x + as_double(displacement.x), center.y + as_double(displacement.y)};
}

// A free group moves on with its center of mass and rotates about it. A group that hangs on
// the world has no motion of its own; a carried group moves against the carrier.
IslandEnergy::Motion IslandEnergy::frame_of(const Group& group, const Drift& drift, std::int32_t state)
{
    if (group.is_carried)
        return carried_motion(arm_of(state));
    if (group.is_anchored)
        return {};
    const Arm at = place_of(state);
    return {drift.vx() - drift.w() * (at.y - drift.y), drift.vy() + drift.w() * (at.x - drift.x), drift.w()};
}

double IslandEnergy::inner_energy(int index, const Drift& drift)
{
    double energy = 0;
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (body(i).group == index)
            energy +=
                0.5 * body(i).twice_kinetic(m_view.states[i], frame_of(m_groups[static_cast<std::size_t>(index)], drift, i));
    }
    return energy;
}

void IslandEnergy::scale(int index, bool exact)
{
    const Group& group = m_groups[static_cast<std::size_t>(index)];
    const double missing = group.of(group.missing) + group.constraint_work;
    // Noise that is cut off at every sub-step would act as a damper; and contacts push out overlaps against the forces.
    const double work = group.of(group.work);
    const bool may_rise = group.may_lose && work < 0 && missing < 0;
    const bool may_stay =
        !(exact && !group.is_carried) &&
        missing >= -energy_rounding / m_subdivisions * std::fabs(group.of(group.first)) - noise_displacement * group.slop_work;
    if (may_stay && !may_rise)
        return;
    Drift drift = drift_of(index);
    double inner = inner_energy(index, drift);
    if (inner + missing < 0)
    { // more than the inner energy: the rotation of the whole gives its energy as well
        drift.inertia = 0;
        inner = inner_energy(index, drift);
    }
    if (const double rise = -(inner + missing) - group.push_out - rest_displacement * group.slop_work; may_rise && rise > 0)
        cut_speeds(index, std::min(rise / -work, 1.0));
    if (may_stay || !(inner > 0))
        return;
    const double by = std::sqrt(std::max(inner + missing, 0.0) / inner);
    const auto change = static_cast<float>(std::min(by, 2.0) - 1);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        BodyState& s = m_view.states[i];
        if (body(i).group != index)
            continue;
        const Motion frame = frame_of(group, drift, i);
        const StateConstants& c = m_view.constants[i];
        const auto scale = [&](float& speed, double of_frame, float inverse_mass)
        { speed += inverse_mass != 0 ? change * (speed - static_cast<float>(of_frame)) : 0; }; // a locked axis does not move
        scale(s.velocity.x, frame.x, c.inverse_mass.x);
        scale(s.velocity.y, frame.y, c.inverse_mass.y);
        scale(s.angular_velocity, frame.w, c.inverse_inertia);
    }
}

// Bodies that move against the forces without energy for it lose that share of their displacement.
void IslandEnergy::cut_speeds(int index, double share)
{
    m_has_cut_speeds = true;
    const bool is_carried = m_groups[static_cast<std::size_t>(index)].is_carried;
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (body(i).group == index)
            cut_speed(i, static_cast<float>(1 - share), is_carried);
    }
}

// The displacement of a carried body is taken relative to the carrier, which takes it along.
void IslandEnergy::cut_speed(std::int32_t state, float rest, bool is_carried)
{
    BodyState& s = m_view.states[state];
    const Body& b = body(state);
    Vec2 position = b.position;
    Rotation rotation = b.rotation;
    if (is_carried)
    {
        const BodyState& c = m_view.states[m_carrier];
        const Rotation turn = c.delta_rotation * carom::inverse(m_carrier_before.delta_rotation);
        const Vec2 arm{static_cast<float>(b.arm.x), static_cast<float>(b.arm.y)};
        position += c.delta_position - m_carrier_before.delta_position + rotate(turn, arm) - arm;
        rotation = turn * rotation;
    }
    s.delta_position = position + rest * (s.delta_position - position);
    const float turn = (s.delta_rotation * carom::inverse(rotation)).angle();
    const Rotation before = s.delta_rotation;
    s.delta_rotation = Rotation::from_angle(rest * turn) * rotation;
    s.turns = static_cast<std::int16_t>(s.turns + turns_by(before, s.delta_rotation, as_double((rest - 1) * turn)));
}

} // namespace carom::internal
