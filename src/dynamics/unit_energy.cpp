#include "dynamics/unit_energy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace carom::internal {

namespace {

constexpr double rounding = 5e-6; // of the energy

double as_double(float x) { return static_cast<double>(x); }

double inverse(float x) { return x > 0 ? 1 / as_double(x) : 0; }

double square(double x) { return x * x; }

bool decays(const StateConstants& c) { return c.linear_decay != 1 || c.angular_decay != 1; }

// Motors and soft holds do work that nobody has counted.
bool is_passive(const JointRecord& joint) { return joint.hertz == 0 && !joint.enable_motor; }

bool may_lose(const JointRecord& joint)
{
    return joint.damping > 0 || joint.impulses[slot_lower] != 0 || joint.impulses[slot_upper] != 0;
}

bool is_loaded(const ContactRow& row)
{
    for (int i = 0; i < row.count; ++i)
    {
        if (row.points[i].normal_impulse > 0)
            return true;
    }
    return false;
}

double stored(const JointRecord& joint, const JointPose& pose)
{
    return 0.5 * as_double(joint.stiffness) * square(as_double(length(pose.gap)) - as_double(joint.upper));
}

} // namespace

double UnitEnergy::Body::twice_kinetic(const BodyState& s, double vx, double vy) const
{
    return mass_x * square(as_double(s.velocity.x) - vx) + mass_y * square(as_double(s.velocity.y) - vy) +
           inertia * square(as_double(s.angular_velocity));
}

void UnitEnergy::Drift::add(const Body& body, const BodyState& s)
{
    mass_x += body.mass_x;
    mass_y += body.mass_y;
    px += body.mass_x * as_double(s.velocity.x);
    py += body.mass_y * as_double(s.velocity.y);
}

void UnitEnergy::begin(const SolverView& view, const SceneState& state, std::span<const JointWork> joints, std::int32_t first,
                       std::int32_t count, float slop)
{
    m_view = view;
    m_state = &state;
    m_joints = joints;
    m_slop = slop;
    m_first = first;
    m_count = std::min(count, most_bodies);
    m_all_driven = all_driven();
    if (m_all_driven)
        return;
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        const BodyState& s = m_view.states[i];
        const StateConstants& c = m_view.constants[i];
        body(i) = {.mass_x = inverse(c.inverse_mass.x),
                   .mass_y = inverse(c.inverse_mass.y),
                   .inertia = inverse(c.inverse_inertia),
                   .position = s.delta_position,
                   .rotation = s.delta_rotation,
                   .group = i - m_first,
                   .flew = flies(i)};
        group_of(i) = {};
    }
    add_kinetic(1);
    add_springs(1);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
        body(i).first = body(i).missing;
}

// Every body hangs on a joint that may do work.
bool UnitEnergy::all_driven()
{
    std::uint64_t driven = 0;
    for (const JointWork& work : m_joints)
    {
        if (is_passive(m_state->joints[work.joint]))
            continue;
        for (const std::int32_t i : {work.a, work.b})
            driven |= is_ours(i) ? std::uint64_t{1} << (i - m_first) : 0;
    }
    return std::popcount(driven) == m_count;
}

// What has landed counts from here.
void UnitEnergy::after_impacts()
{
    if (m_all_driven)
        return;
    add_kinetic(1);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (!body(i).flew || flies(i))
            continue;
        body(i).position = m_view.states[i].delta_position;
        body(i).rotation = m_view.states[i].delta_rotation;
    }
}

void UnitEnergy::before_impacts()
{
    if (!m_all_driven)
        add_kinetic(-1);
}

void UnitEnergy::add_kinetic(double sign)
{
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
        body(i).missing += 0.5 * sign * body(i).twice_kinetic(m_view.states[i], 0, 0);
}

void UnitEnergy::add_springs(double sign)
{
    for (const JointWork& work : m_joints)
    {
        const JointRecord& joint = m_state->joints[work.joint];
        if (joint.kind == JointType::Spring)
            body(is_ours(work.a) ? work.a : work.b).missing += sign * stored(joint, present_pose(m_view, work));
    }
}

// Forces are even over the sub-step: they work along the way that was gone, however it bent.
void UnitEnergy::add_work()
{
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        const BodyState& s = m_view.states[i];
        const StateConstants& c = m_view.constants[i];
        const Vec2 way = s.delta_position - body(i).position;
        const Rotation turn = s.delta_rotation * carom::inverse(body(i).rotation);
        body(i).missing += body(i).mass_x * as_double(c.acceleration.x) * as_double(way.x) +
                           body(i).mass_y * as_double(c.acceleration.y) * as_double(way.y) +
                           body(i).inertia * as_double(c.angular_acceleration) * as_double(turn.s);
    }
}

// --- who belongs together -----------------------------------------------------------------------------------------------------------

void UnitEnergy::connect(std::int32_t a, std::int32_t b)
{
    if (!is_ours(a) || !is_ours(b) || body(a).group == body(b).group)
        return;
    const int old = std::max(body(a).group, body(b).group);
    const int joined = std::min(body(a).group, body(b).group);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (body(i).group == old)
            body(i).group = joined;
    }
}

void UnitEnergy::connect_rows(std::span<const ContactRow> rows)
{
    for (const ContactRow& row : rows)
    {
        if (is_loaded(row))
            connect(row.a, row.b);
    }
}

void UnitEnergy::join(std::int32_t own, std::int32_t other)
{
    Group& group = group_of(own);
    group.is_joined = true;
    if (is_ours(other))
        return;
    const BodyState& anchor = m_view.states[other];
    group.is_anchored = true;
    group.is_passive &= anchor.velocity == Vec2{} && anchor.angular_velocity == 0;
}

void UnitEnergy::note_joint(const JointWork& work)
{
    const JointRecord& joint = m_state->joints[work.joint];
    for (const auto& [own, other] : {std::pair{work.a, work.b}, std::pair{work.b, work.a}})
    {
        if (!is_ours(own))
            continue;
        join(own, other);
        group_of(own).is_passive &= is_passive(joint);
        group_of(own).may_lose |= may_lose(joint);
    }
}

void UnitEnergy::note_rows(std::span<const ContactRow> rows)
{
    for (const ContactRow& row : rows)
    {
        if (is_loaded(row))
            note_row(row);
    }
}

void UnitEnergy::note_row(const ContactRow& row)
{
    for (const auto& [own, other] : {std::pair{row.a, row.b}, std::pair{row.b, row.a}})
    {
        if (!is_ours(own))
            continue;
        join(own, other);
        group_of(own).is_passive &= row.surface_speed == 0;
        group_of(own).may_lose = true;
        group_of(own).touches = true;
    }
}

void UnitEnergy::note_load(std::span<const ContactRow> rows, std::span<const ContactRow> late_rows)
{
    if (m_all_driven)
        return;
    for (const JointWork& work : m_joints)
        connect(work.a, work.b);
    connect_rows(rows);
    connect_rows(late_rows);
    for (const JointWork& work : m_joints)
        note_joint(work);
    note_rows(rows);
    note_rows(late_rows);
}

// --- scaling ------------------------------------------------------------------------------------------------------------------------

void UnitEnergy::restore(bool exact)
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
        if (group.touches)
            group.push_out += as_double(m_slop) * force_on(i);
        group.is_passive &= !decays(m_view.constants[i]) && !flies(i);
    }
    for (int g = 0; g < m_count; ++g)
    {
        const Group& group = m_groups[static_cast<std::size_t>(g)];
        if (group.is_joined && group.is_passive)
            scale(g, exact && !group.may_lose);
    }
}

double UnitEnergy::force_on(std::int32_t state)
{
    const Vec2 a = m_view.constants[state].acceleration;
    return std::sqrt(square(body(state).mass_x * as_double(a.x)) + square(body(state).mass_y * as_double(a.y)));
}

// What is free moves on with its center of mass; what hangs on the world has no motion of its own.
void UnitEnergy::scale(int index, bool exact)
{
    const Group& group = m_groups[static_cast<std::size_t>(index)];
    // Cut off at every sub-step, noise would be a damper; and contacts push out overlaps against the forces.
    if (!exact && group.missing >= -rounding * group.first - group.push_out)
        return;
    Drift drift;
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (body(i).group == index && !group.is_anchored)
            drift.add(body(i), m_view.states[i]);
    }
    double inner = 0;
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (body(i).group == index)
            inner += 0.5 * body(i).twice_kinetic(m_view.states[i], drift.vx(), drift.vy());
    }
    if (!(inner > 0))
        return;
    const double by = std::sqrt(std::max(inner + group.missing, 0.0) / inner);
    const auto change = static_cast<float>(std::min(by, 2.0) - 1);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        BodyState& s = m_view.states[i];
        if (body(i).group != index)
            continue;
        s.velocity += change * (s.velocity - Vec2{static_cast<float>(drift.vx()), static_cast<float>(drift.vy())});
        s.angular_velocity += change * s.angular_velocity;
    }
}

} // namespace carom::internal
