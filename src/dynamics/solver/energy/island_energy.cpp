// The part of IslandEnergy that sums up energy and work, and finds groups; energy_scaling.cpp scales speeds.

#include "dynamics/solver/energy/island_energy.h"

#include "core/as_double.h"
#include "core/index.h"
#include "dynamics/state/turns.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace carom::internal {

namespace {

double inverse(float x) { return x > 0 ? 1 / as_double(x) : 0; }

// Motors and soft joints do work that is not counted.
bool is_passive(const JointRecord& joint) { return joint.hertz == 0 && !joint.enable_motor; }

bool may_lose(const JointRecord& joint, const JointWork& work)
{
    return joint.damping > 0 || std::ranges::any_of(work.rows.axes(),
                                                    [&](const JointAxis& axis)
                                                    {
                                                        const AxisImpulses impulses = axis_impulses(joint, axis.number);
                                                        return impulses.lower != 0 || impulses.upper != 0;
                                                    });
}

// False for a slack rope and for a distant limit.
bool is_at_work(const JointRecord& joint, const JointWork& work)
{
    return joint.kind == JointType::Spring || work.rows.held_count > 0 ||
           std::ranges::any_of(work.rows.axes(), [&](const JointAxis& axis) { return axis_impulse(joint, axis.number) != 0; });
}

bool is_loaded(const ContactConstraint& constraint)
{
    return constraint.count > 0 && (constraint.pressed != 0 || bears_load(constraint));
}

double stored(const JointRecord& joint, const JointPose& pose)
{
    return 0.5 * as_double(joint.stiffness) * square(as_double(length(pose.gap)) - as_double(joint.upper));
}

} // namespace

double IslandEnergy::Body::twice_kinetic(const BodyState& s, const Motion& frame) const
{
    return mass_x * square(as_double(s.velocity.x) - frame.x) + mass_y * square(as_double(s.velocity.y) - frame.y) +
           inertia * square(as_double(s.angular_velocity) - frame.w);
}

void IslandEnergy::Drift::add(const Body& body, const BodyState& s, const Arm& at)
{
    mass_x += body.mass_x;
    mass_y += body.mass_y;
    px += body.mass_x * as_double(s.velocity.x);
    py += body.mass_y * as_double(s.velocity.y);
    x += body.mass_x * at.x;
    y += body.mass_x * at.y;
}

void IslandEnergy::Drift::center()
{
    x = mass_x > 0 ? x / mass_x : 0;
    y = mass_x > 0 ? y / mass_x : 0;
}

// Bodies with locked axes do not turn about a common center.
void IslandEnergy::Drift::add_spin(const Body& body, const BodyState& s, const Arm& at)
{
    if (mass_x != mass_y)
        return;
    const double dx = at.x - x;
    const double dy = at.y - y;
    inertia += body.inertia + body.mass_x * (square(dx) + square(dy));
    spin += body.inertia * as_double(s.angular_velocity) +
            body.mass_x * (dx * (as_double(s.velocity.y) - vy()) - dy * (as_double(s.velocity.x) - vx()));
}

void IslandEnergy::begin(const SolverView& view, const StepContext& ctx, std::span<JointWork> joints, const Island& island)
{
    m_view = view;
    m_state = &ctx.state;
    m_joints = joints;
    m_slop = ctx.scene.tolerances.slop;
    m_rest_speed = ctx.rest_speed;
    m_subdivisions = island.policy.subdivisions;
    m_first = island.first_state + 1;
    m_count = island.dynamic_count;
    make_room(static_cast<std::size_t>(m_count));
    m_has_cut_speeds = false;
    m_all_driven = all_driven();
    if (m_all_driven)
        return;
    find_carrier(ctx, island);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
        place_body(ctx, i);
    add_kinetic(1);
    add_springs(1);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
        body(i).first = body(i).missing;
}

void IslandEnergy::make_room(std::size_t count)
{
    m_bodies = m_few_bodies;
    m_groups = m_few_groups;
    if (count <= few)
        return;
    m_many_bodies.resize(std::max(m_many_bodies.size(), count));
    m_many_groups.resize(m_many_bodies.size());
    m_bodies = m_many_bodies;
    m_groups = m_many_groups;
}

void IslandEnergy::place_body(const StepContext& ctx, std::int32_t state)
{
    const BodyState& s = m_view.states[state];
    const StateConstants& c = m_view.constants[state];
    Body& b = body(state);
    b = {.mass_x = inverse(c.inverse_mass.x),
         .mass_y = inverse(c.inverse_mass.y),
         .inertia = inverse(c.inverse_inertia),
         .position = s.delta_position,
         .rotation = s.delta_rotation,
         .group = state - m_first,
         .flew = flies(state)};
    group_of(state) = {};
    const auto center = [&](std::int32_t i)
    { return m_state->sims[static_cast<std::size_t>(ctx.scratch.solver.state_bodies[static_cast<std::size_t>(i)])].center; };
    const Position own = center(state);
    const Position origin = center(has_carrier() ? m_carrier : m_first);
    b.center = {own.x - origin.x, own.y - origin.y};
    if (has_carrier())
        b.arm = arm_of(state);
}

// --- the carrier's frame ------------------------------------------------------------------------------------------------------------

// Kinematic bodies come after the dynamic ones. With two that move there is no frame in which neither does work.
void IslandEnergy::find_carrier(const StepContext& ctx, const Island& island)
{
    m_carrier = none;
    for (std::int32_t i = m_first + island.dynamic_count; i < island.first_state + island.state_count; ++i)
    {
        const BodyState& s = ctx.scratch.solver.states[static_cast<std::size_t>(i)];
        if (s.velocity == Vec2{} && s.angular_velocity == 0)
            continue;
        const bool is_second = has_carrier();
        m_carrier = is_second ? none : i;
        m_carrier_before = s;
        if (is_second)
            return;
    }
}

IslandEnergy::Arm IslandEnergy::arm_of(std::int32_t state)
{
    const Vec2 own = m_view.states[state].delta_position;
    const Vec2 carrier = m_view.states[m_carrier].delta_position;
    const Arm& center = body(state).center;
    return {center.x + as_double(own.x) - as_double(carrier.x), center.y + as_double(own.y) - as_double(carrier.y)};
}

IslandEnergy::Motion IslandEnergy::carried_motion(const Arm& arm) const
{
    const BodyState& c = m_view.states[m_carrier];
    const double w = as_double(c.angular_velocity);
    return {as_double(c.velocity.x) - w * arm.y, as_double(c.velocity.y) + w * arm.x, w};
}

IslandEnergy::Energy IslandEnergy::energy_of(std::int32_t state)
{
    const BodyState& s = m_view.states[state];
    const Body& b = body(state);
    Energy energy{0.5 * b.twice_kinetic(s, {}), 0};
    if (!has_carrier())
        return energy;
    const Arm arm = arm_of(state);
    const Motion frame = carried_motion(arm);
    energy.carried = 0.5 * b.twice_kinetic(s, frame) - driven_outwards(b, arm);
    return energy;
}

// The energy that the centrifugal force has given at that distance from the carrier's center.
double IslandEnergy::driven_outwards(const Body& b, const Arm& arm) const
{
    return 0.5 * square(as_double(m_view.states[m_carrier].angular_velocity)) *
           (b.mass_x * square(arm.x) + b.mass_y * square(arm.y));
}

// Forces are constant over the sub-step: they work along the displacement, whatever the curvature of the path.
IslandEnergy::Energy IslandEnergy::work_on(std::int32_t state)
{
    const BodyState& s = m_view.states[state];
    const StateConstants& c = m_view.constants[state];
    const Body& b = body(state);
    const Vec2 displacement = s.delta_position - b.position;
    const Rotation turn = s.delta_rotation * carom::inverse(b.rotation);
    const auto work = [&](double x, double y, double w)
    {
        return b.mass_x * as_double(c.acceleration.x) * x + b.mass_y * as_double(c.acceleration.y) * y +
               b.inertia * as_double(c.angular_acceleration) * w;
    };
    Energy energy{work(as_double(displacement.x), as_double(displacement.y), as_double(turn.s)), 0};
    if (!has_carrier())
        return energy;
    const Arm arm = arm_of(state);
    const Motion frame = carried_motion({0.5 * (arm.x + b.arm.x), 0.5 * (arm.y + b.arm.y)});
    const double h = as_double(m_view.h);
    energy.carried =
        work(as_double(displacement.x) - h * frame.x, as_double(displacement.y) - h * frame.y, as_double(turn.s) - h * frame.w);
    return energy;
}

// --- balance of the energy ----------------------------------------------------------------------------------------------------------

// True if every body is on a joint that may do work.
bool IslandEnergy::all_driven()
{
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
        body(i).is_driven = false;
    std::int32_t driven = 0;
    for (const JointWork& work : m_joints)
    {
        if (is_passive(m_state->joints[work.joint]))
            continue;
        for (const std::int32_t i : {work.a, work.b})
        {
            if (is_ours(i))
                driven += std::exchange(body(i).is_driven, true) ? 0 : 1;
        }
    }
    return driven == m_count;
}

// A body that has landed counts from here.
void IslandEnergy::after_impacts(std::span<const StoppedJoint> stopped)
{
    if (m_all_driven)
        return;
    add_kinetic(1);
    for (const StoppedJoint& s : stopped)
    {
        if (is_ours(s.state))
            body(s.state).missing += {s.energy, s.energy};
    }
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        const BodyState& s = m_view.states[i];
        Body& b = body(i);
        if (flies(i))
            continue;
        b.is_displaced = b.flew || s.delta_position != b.position_before_impacts;
        if (b.flew)
        {
            b.position = s.delta_position;
            b.rotation = s.delta_rotation;
            if (has_carrier())
                b.arm = arm_of(i);
        }
        else if ((s.flags & body_flag::unbound) != 0)
        { // the speeds already include the work of forces along the displacement that an impact added
            b.position += s.delta_position - b.position_before_impacts;
            const float turn = (s.delta_rotation * carom::inverse(b.rotation_before_impacts)).angle();
            b.rotation = Rotation::from_angle(turn) * b.rotation;
        }
    }
}

void IslandEnergy::before_impacts()
{
    if (m_all_driven)
        return;
    add_kinetic(-1);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        body(i).position_before_impacts = m_view.states[i].delta_position;
        body(i).rotation_before_impacts = m_view.states[i].delta_rotation;
    }
}

void IslandEnergy::add_kinetic(double sign)
{
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        const Energy energy = energy_of(i);
        body(i).missing += {sign * energy.standing, sign * energy.carried};
    }
}

void IslandEnergy::add_springs(double sign)
{
    for (const JointWork& work : m_joints)
    {
        const JointRecord& joint = m_state->joints[work.joint];
        if (joint.kind != JointType::Spring)
            continue;
        const double energy = sign * stored(joint, present_pose(m_view, work));
        body(is_ours(work.a) ? work.a : work.b).missing += {energy, energy};
    }
}

void IslandEnergy::add_work()
{
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        Body& b = body(i);
        b.work = work_on(i);
        b.missing += b.work;
        if (has_carrier())
            b.work.carried += driven_outwards(b, arm_of(i)) - driven_outwards(b, b.arm);
    }
}

// --- groups of connected bodies -----------------------------------------------------------------------------------------------------

void IslandEnergy::connect(std::int32_t a, std::int32_t b)
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

void IslandEnergy::connect_constraints(std::span<const ContactConstraint> constraints)
{
    for (const ContactConstraint& constraint : constraints)
    {
        if (is_loaded(constraint))
            connect(constraint.a, constraint.b);
    }
}

void IslandEnergy::join(std::int32_t own, std::int32_t other)
{
    Group& group = group_of(own);
    if (is_ours(other))
        return;
    const BodyState& anchor = m_view.states[other];
    if (other == m_carrier)
        group.is_carried = true;
    else if (anchor.velocity == Vec2{} && anchor.angular_velocity == 0)
        group.is_anchored = true;
    else
        group.is_passive = false;
}

// Impulse times the displacement by which a constraint has corrected an error that others had caused.
double IslandEnergy::take_work(JointWork& work) const
{
    const JointRecord& joint = m_state->joints[work.joint];
    const JointErrors errors = work.errors();
    const auto make_good = [&](std::size_t i, int slot)
    {
        const float change = errors[i] - work.errors_before[i];
        const float made_good =
            work.moved[i] > 0 ? std::clamp(change, -work.moved[i], 0.0f) : std::clamp(change, 0.0f, -work.moved[i]);
        work.moved[i] += made_good;
        return as_double(joint.impulses[slot]) * as_double(made_good);
    };
    double sum = 0;
    for (const JointAxis& axis : work.rows.axes())
    {
        for (const JointSlot limit : {slot_lower, slot_upper})
            sum += make_good(error_of_limit(axis.number, limit), slot_of_axis(axis.number, limit));
    }
    for (int i = 0; i < work.rows.held_count; ++i)
        sum += make_good(as_index(i), slot_held + i);
    return sum * as_double(m_view.inverse_h);
}

void IslandEnergy::note_joint(JointWork& work)
{
    const JointRecord& joint = m_state->joints[work.joint];
    Group& first = group_of(is_ours(work.a) ? work.a : work.b);
    for (int i = 0; i < work.rows.held_count; ++i)
        first.is_passive &= std::fabs(work.moved[as_index(i)]) <= m_slop; // beyond it, an impact
    first.constraint_work += take_work(work);
    for (const auto& [own, other] : {std::pair{work.a, work.b}, std::pair{work.b, work.a}})
    {
        if (!is_ours(own))
            continue;
        if (is_at_work(joint, work))
        {
            join(own, other);
            const bool drifts = (m_view.states[own].flags & body_flag::unbound) != 0 && !body(own).is_displaced;
            group_of(own).is_joined |= joint.kind != JointType::Spring || !drifts;
            group_of(own).may_lose |= joint.kind == JointType::Spring && !drifts;
        }
        group_of(own).is_passive &= is_passive(joint);
        group_of(own).may_lose |= may_lose(joint, work);
    }
}

void IslandEnergy::note_constraints(std::span<const ContactConstraint> constraints)
{
    for (const ContactConstraint& constraint : constraints)
    {
        if (is_loaded(constraint))
            note_constraint(constraint);
    }
}

// Load times the displacement by which it has pushed an overlap out; the impulse of an impact is no load.
double IslandEnergy::push_out_of(const ContactConstraint& constraint) const
{
    double work = 0;
    for (int i = 0; i < constraint.count; ++i)
    {
        const ConstraintPoint& p = constraint.points[i];
        const float out = std::min(constraint_separation(m_view, constraint, p), 0.0f) - std::min(p.separation_before, 0.0f);
        if (p.approach <= m_rest_speed)
            work += as_double(p.normal_impulse) * as_double(m_view.inverse_h) * as_double(std::max(out, 0.0f));
    }
    return work;
}

void IslandEnergy::note_constraint(const ContactConstraint& constraint)
{
    group_of(is_ours(constraint.a) ? constraint.a : constraint.b).push_out += push_out_of(constraint);
    for (const auto& [own, other] : {std::pair{constraint.a, constraint.b}, std::pair{constraint.b, constraint.a}})
    {
        if (!is_ours(own))
            continue;
        join(own, other);
        group_of(own).is_joined = true;
        group_of(own).is_passive &= constraint.surface_speed == 0;
        group_of(own).may_lose = true;
        group_of(own).touches = true;
    }
}

void IslandEnergy::note_load(std::span<const ContactConstraint> constraints, std::span<const ContactConstraint> late_constraints)
{
    if (m_all_driven)
        return;
    for (const JointWork& work : m_joints)
        connect(work.a, work.b);
    connect_constraints(constraints);
    connect_constraints(late_constraints);
    for (JointWork& work : m_joints)
        note_joint(work);
    note_constraints(constraints);
    note_constraints(late_constraints);
}

} // namespace carom::internal
