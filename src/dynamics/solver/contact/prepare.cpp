// Prepares fliers and contact constraints from the records.

#include "dynamics/solver/contact/prepare.h"
#include "dynamics/solver/bounce/standing_loads.h"
#include "dynamics/solver/effective_mass.h"
#include "geometry/leaf_traits.h"

#include "dynamics/solver/joint/joint_solver.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/scene_data.h"
#include "geometry/surface.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace carom::internal {

namespace {

// A push may have given the center of mass a velocity that the pivot forbids. The pivot takes it plastically: the angular momentum about the pivot is kept.
void take_up_velocity(const BodySim& sim, Flier& f)
{
    const double mass = sim.mass;
    const double vx = sim.velocity.x;
    const double vy = sim.velocity.y;
    const double spin = static_cast<double>(sim.inertia) * static_cast<double>(sim.angular_velocity);
    f.w = f.inverse_inertia * (spin + mass * (f.arm_x * vy - f.arm_y * vx));
    f.reaction += Vec2{static_cast<float>(mass * (-f.w * f.arm_y - vx)), static_cast<float>(mass * (f.w * f.arm_x - vy))};
}

// Sets up the rotation about the pivot: the hinge's angle at the start of the step, and how far its limits let the body turn from there.
void hinge(const StepContext& ctx, int index, const BodySim& sim, Flier& f)
{
    const JointRecord& joint = ctx.state.joints[index];
    const bool is_b = joint.body_b == f.body;
    f.local_reference = is_b ? joint.anchor_b : joint.anchor_a;
    const Vec2 arm = rotate(sim.rotation, sim.local_center - f.local_reference);
    f.arm_x = arm.x;
    f.arm_y = arm.y;
    f.x = -f.arm_x;
    f.y = -f.arm_y;
    f.vx = f.vy = 0;
    f.inverse_mass_x = f.inverse_mass_y = 0;
    f.inverse_inertia =
        1 / (static_cast<double>(sim.inertia) + static_cast<double>(sim.mass) * (f.arm_x * f.arm_x + f.arm_y * f.arm_y));
    take_up_velocity(sim, f);
    if (!joint.enable_limit)
        return;
    const auto angle = static_cast<double>(hinge_angle(ctx.state, joint));
    const auto lower = static_cast<double>(joint.lower);
    const auto upper = static_cast<double>(joint.upper);
    f.lower = is_b ? lower - angle : angle - upper;
    f.upper = is_b ? upper - angle : angle - lower;
}

} // namespace

Flier make_flier(const StepContext& ctx, std::int32_t state, int body, int joint)
{
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    Flier flier;
    flier.state = state;
    flier.body = body;
    flier.joint = joint;
    flier.vx = sim.velocity.x;
    flier.vy = sim.velocity.y;
    flier.w = sim.angular_velocity;
    flier.inverse_mass_x = sim.inverse_mass.x;
    flier.inverse_mass_y = sim.inverse_mass.y;
    flier.inverse_inertia = sim.inverse_inertia;
    flier.local_reference = sim.local_center;
    flier.size = sim.size;
    if (joint != none)
        hinge(ctx, joint, sim, flier);
    return flier;
}

namespace {

// 1 / (J M^-1 J^T) along a unit direction d at lever arms ra, rb; 0 where no body can move, as through the pivot of a body that only turns.
float effective_mass(const StateConstants& a, const StateConstants& b, Vec2 d, Vec2 ra, Vec2 rb)
{
    const float ca = cross(ra, d);
    const float cb = cross(rb, d);
    const ImpulseLine<float> line{d.x, d.y, ca};
    const float k = response(a.inverse(), line, line, b.inverse(), cb, cb);
    const float at_most = dot(ra, ra) * a.inverse_inertia + dot(rb, rb) * b.inverse_inertia;
    return exceeds_rounding(k, at_most) ? 1 / k : 0;
}

// Coupling of the normals of two points. Points that nearly coincide share their load anyway; solving for both would only divide noise.
float coupling(const StateConstants& a, const StateConstants& b, const ContactConstraint& constraint)
{
    const ConstraintPoint& p = constraint.points[0];
    const ConstraintPoint& q = constraint.points[1];
    const Vec2 n = constraint.n;
    const float k = response<float>(a.inverse(), {n.x, n.y, cross(p.ra, n)}, {n.x, n.y, cross(q.ra, n)}, b.inverse(),
                                    cross(p.rb, n), cross(q.rb, n));
    const bool distinct = p.normal_mass > 0 && q.normal_mass > 0 && k * k * p.normal_mass * q.normal_mass < 0.999f;
    return distinct ? k : 0;
}

void weigh(const Scratch& scratch, ContactConstraint& constraint)
{
    const StateConstants& a = scratch.solver.constants[static_cast<std::size_t>(constraint.a)];
    const StateConstants& b = scratch.solver.constants[static_cast<std::size_t>(constraint.b)];
    for (ConstraintPoint& p : std::span(constraint.points).first(static_cast<std::size_t>(constraint.count)))
    {
        p.normal_mass = effective_mass(a, b, constraint.n, p.ra, p.rb);
        p.tangent_mass = effective_mass(a, b, perp(constraint.n), p.ra, p.rb);
    }
    constraint.coupling = constraint.count == 2 ? coupling(a, b, constraint) : 0;
}

// The points of a circle about the center of mass do not turn with it.
bool turns_with_body(Vec2 arm, Vec2 n) { return std::fabs(cross(arm, n)) > round_arm * std::fabs(dot(arm, n)); }

} // namespace

void set_constraint_geometry(const Scratch& scratch, ContactConstraint& constraint, const Manifold& m)
{
    const BodyState& sa = scratch.solver.states[static_cast<std::size_t>(constraint.a)];
    const BodyState& sb = scratch.solver.states[static_cast<std::size_t>(constraint.b)];
    constraint.n = m.normal;
    constraint.count = m.count;
    constraint.turn_a = sa.delta_rotation;
    constraint.turn_b = sb.delta_rotation;
    for (int i = 0; i < m.count; ++i)
    {
        ConstraintPoint& p = constraint.points[i];
        p.ra = m.points[i].anchor_a;
        p.rb = m.points[i].anchor_b;
        p.ra0 = inverse_rotate(sa.delta_rotation, p.ra);
        p.rb0 = inverse_rotate(sb.delta_rotation, p.rb);
        p.base = m.points[i].separation - dot(m.normal, sb.delta_position - sa.delta_position + p.rb - p.ra);
    }
    weigh(scratch, constraint);
}

void turn_arms(const Scratch& scratch, ContactConstraint& constraint)
{
    for (int i = 0; i < constraint.count; ++i)
    {
        ConstraintPoint& p = constraint.points[i];
        p.ra = turns_with_body(p.ra, constraint.n) ? p.ra0 : p.ra;
        p.rb = turns_with_body(p.rb, constraint.n) ? p.rb0 : p.rb;
    }
    weigh(scratch, constraint);
}

float core_depth(const SceneState& state, const Contact& contact, const Manifold& manifold, bool a_gives)
{
    auto depth = static_cast<float>(0.5 * inner_radius(leaf_view(state, a_gives ? contact.shape_a : contact.shape_b)));
    for (int i = 0; i < manifold.count; ++i)
        depth = std::max(depth, -manifold.points[i].separation);
    return depth;
}

float rolling_length(const SceneState& state, const Contact& contact)
{
    const Leaf& a = state.shapes[contact.shape_a].leaf;
    const Leaf& b = state.shapes[contact.shape_b].leaf;
    return contact.rolling_resistance * std::fmax(traits_of(a).is_bounded ? a.r0 : 0, b.r0);
}

void scale_constraint(ContactConstraint& constraint, float by)
{
    constraint.rolling_impulse *= by;
    for (ConstraintPoint& p : constraint.points)
    {
        p.normal_impulse *= by;
        p.tangent_impulse *= by;
        p.last_impulse *= by;
        p.older_impulse *= by;
        p.standing_load *= by;
    }
}

std::int32_t state_for_constraints(const StepContext& ctx, const Island& island, int body)
{
    const BodyRecord& record = ctx.state.bodies[body];
    if (record.awake_index == none)
        return island.first_state;
    const std::int32_t end = island.first_state + island.state_count;
    if (record.type == BodyType::Dynamic)
    {
        const std::int32_t s = ctx.scratch.solver.state_of[static_cast<std::size_t>(record.awake_index)];
        return s >= island.first_state && s < end ? s : none;
    }
    for (std::int32_t s = island.first_state + 1 + island.dynamic_count; s < end; ++s)
    {
        if (ctx.scratch.solver.state_bodies[static_cast<std::size_t>(s)] == body)
            return s;
    }
    return none;
}

ContactConstraint prepare_constraint(const StepContext& ctx, int index, const Manifold& manifold, std::int32_t a, std::int32_t b)
{
    const Contact& contact = ctx.state.contacts[index];
    const StateConstants& ca = ctx.scratch.solver.constants[static_cast<std::size_t>(a)];
    const StateConstants& cb = ctx.scratch.solver.constants[static_cast<std::size_t>(b)];
    ContactConstraint constraint;
    constraint.a = a;
    constraint.b = b;
    constraint.contact = index;
    constraint.friction = contact.friction;
    constraint.surface_speed = contact.surface_speed;
    const bool immovable = ca.inverse_mass == Vec2{} || cb.inverse_mass == Vec2{};
    constraint.softness = immovable ? ctx.static_softness : ctx.contact_softness;
    if (immovable)
        constraint.core = core_depth(ctx.state, contact, manifold, ca.inverse_mass != Vec2{});
    set_constraint_geometry(ctx.scratch, constraint, manifold);
    for (int i = 0; i < constraint.count; ++i)
    {
        const PointImpulses& impulses = impulses_of(ctx.state, index).points[i];
        constraint.points[i].normal_impulse = impulses.normal;
        constraint.points[i].tangent_impulse = impulses.tangent;
        constraint.points[i].standing_load = load_before_last(impulses, ctx.substeps / ctx.subdivisions);
        constraint.points[i].older_impulse = constraint.points[i].standing_load;
        constraint.points[i].last_impulse = std::min(impulses.normal, constraint.points[i].standing_load);
    }
    if (ctx.subdivisions > 1)
        scale_constraint(constraint, 1 / static_cast<float>(ctx.subdivisions));
    if (contact.rolling_resistance > 0)
    {
        const float k = ca.inverse_inertia + cb.inverse_inertia;
        constraint.rolling = rolling_length(ctx.state, contact);
        constraint.rolling_impulse = manifold.rolling_impulse / static_cast<float>(ctx.subdivisions);
        constraint.rolling_mass = k > 0 ? 1 / k : 0;
    }
    return constraint;
}

} // namespace carom::internal
