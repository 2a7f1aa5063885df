// The state hash: all state that determines the future, field by field.

#include "carom/scene.h"
#include "core/hash.h"
#include "scene/access.h"

namespace carom {

using namespace internal;

namespace {

void add(Hasher& h, Vec2 v)
{
    h.add(v.x);
    h.add(v.y);
}

void add(Hasher& h, Position p)
{
    h.add(p.x);
    h.add(p.y);
}

void add(Hasher& h, Rotation q)
{
    h.add(q.c);
    h.add(q.s);
}

void add(Hasher& h, const FloatBox& b)
{
    h.add(b.lx);
    h.add(b.ly);
    h.add(b.ux);
    h.add(b.uy);
}

void add_body(Hasher& h, const BodyRecord& r, const BodySim& s)
{
    h.add(static_cast<int>(r.type) | (static_cast<int>(r.enabled) << 2) | (static_cast<int>(r.can_sleep) << 3) |
          (static_cast<int>(s.caches_manifolds) << 8) | (static_cast<int>(r.has_target) << 4) |
          (static_cast<int>(r.locks.linear_x) << 5) | (static_cast<int>(r.locks.linear_y) << 6) |
          (static_cast<int>(r.locks.angular) << 7) | (static_cast<int>(r.plane_cell) << 16));
    h.add(r.awake_index);
    add(h, s.center);
    add(h, s.rotation);
    add(h, s.local_center);
    add(h, s.velocity);
    h.add(s.angular_velocity);
    add(h, s.inverse_mass);
    h.add(s.inverse_inertia);
    add(h, s.force);
    h.add(s.torque);
    h.add(s.gravity_scale);
    h.add(s.linear_damping);
    h.add(s.angular_damping);
    h.add(s.sleep_time);
}

void add_material(Hasher& h, const SceneState& state, const ShapeRecord& s)
{
    const RareTraits& rare = rare_traits_of(state, s);
    const Field& field = rare.field;
    h.add(static_cast<int>(s.trigger) | (static_cast<int>(s.yields_material) << 1));
    for (const float value : {s.density, s.friction, s.restitution, s.rolling_resistance, s.surface_speed, rare.kick.speed,
                              rare.kick.threshold, rare.kick.cooldown, field.drag})
        h.add(value);
    for (std::uint32_t i = 0; i < rare.restitution_curve.count; ++i)
    {
        h.add(rare.restitution_curve.points[i].speed);
        h.add(rare.restitution_curve.points[i].restitution);
    }
    h.add(rare.kick_ready);
    add(h, rare.one_way);
    add(h, field.force);
    add(h, field.acceleration);
    h.add(static_cast<int>(field.only_if_moving_along));
    h.add(s.filter.category);
    h.add(s.filter.mask);
    h.add(s.filter.group);
}

void add_leaf(Hasher& h, const LeafView& v)
{
    const Leaf& leaf = *v.leaf;
    h.add(static_cast<int>(leaf.type) | (static_cast<int>(leaf.sides) << 8));
    add(h, leaf.p0);
    add(h, leaf.p1);
    const ArcSpan span = v.span == nullptr ? ArcSpan{} : *v.span;
    for (const float value : {leaf.r0, leaf.r1, leaf.arc_radius, span.start_angle, span.sweep})
        h.add(value);
    for (int i = 0; leaf.type == LeafType::Polygon && i < leaf.count; ++i)
        add(h, v.points[i]);
}

void add_shape(Hasher& h, const SceneState& state, int shape)
{
    const ShapeRecord& s = state.shapes[shape];
    h.add(s.body);
    h.add(s.owner);
    add_material(h, state, s);
    if (!s.has_leaf)
        return;
    add_leaf(h, view(s.leaf, state.leaf_store));
    if (state.broad_phase.has(shape))
        add(h, state.broad_phase.box(shape));
}

void add_contact(Hasher& h, const SceneState& state, int index)
{
    const Contact& c = state.contacts[index];
    h.add(c.shape_a);
    h.add(c.shape_b);
    // Excludes flags that only say where the rest is stored, or that repeat what bodies and shapes say.
    h.add(static_cast<int>(c.flags & ~(contact_flag::followed | contact_flag::sleeper | contact_flag::piece)));
    h.add(c.manifold.count);
    h.add(c.manifold.rolling_impulse);
    for (int i = 0; i < c.manifold.count; ++i)
    {
        h.add(impulses_of(state, index).points[i].normal);
        h.add(impulses_of(state, index).points[i].tangent);
        h.add(impulses_of(state, index).points[i].total_normal); // tells blows from standing loads
        h.add(static_cast<int>(c.manifold.points[i].feature));
    }
}

void add_joint(Hasher& h, const JointRecord& j)
{
    h.add(static_cast<int>(j.kind) | (static_cast<int>(j.collide_connected) << 8) | (static_cast<int>(j.enable_limit) << 9) |
          (static_cast<int>(j.enable_motor) << 10) | (static_cast<int>(j.knows_errors) << 11) |
          (static_cast<int>(j.yields) << 12));
    h.add(j.body_a);
    h.add(j.body_b);
    add(h, j.anchor_a);
    add(h, j.anchor_b);
    add(h, j.axis_a);
    for (const float value : {j.reference_angle, j.stiffness, j.damping, j.lower, j.upper, j.limit_restitution, j.motor_speed,
                              j.max_motor, j.hertz, j.damping_ratio, j.spring_target})
        h.add(value);
    if (j.turns != 0)
        h.add(j.turns);
    for (const float impulse : j.impulses)
        h.add(impulse);
    for (const float error : j.left_errors)
        h.add(error);
}

} // namespace

std::uint64_t Scene::state_hash() const
{
    const SceneState& state = m_data->state;
    Hasher h;
    h.add(state.step_count);
    h.add(state.accumulator);
    h.add(state.substep_of_impulses);
    h.add(state.longest_substep);
    add(h, state.gravity);
    h.add(state.ignored.hash());
    for (const RattlingBody& r : state.rattling)
    {
        h.add(r.body);
        h.add(r.impacts);
    }
    for (int i = 0; i < state.bodies.capacity(); ++i)
    {
        if (!state.bodies.is_live(i))
            continue;
        const BodyRecord& body = state.bodies[i];
        add_body(h, body, state.sims[static_cast<std::size_t>(i)]);
        if (body.sleep_speed != m_data->tolerances.sleep_speed)
            h.add(body.sleep_speed);
        if (const std::int32_t turns = state.turns[static_cast<std::size_t>(i)]; turns != 0)
            h.add(turns);
        if (state.sims[static_cast<std::size_t>(i)].sleep_time > 0)
        {
            const QuietStart& start = state.quiet_starts[static_cast<std::size_t>(i)];
            add(h, start.center);
            h.add(start.rotation.c);
            h.add(start.rotation.s);
            h.add(start.time);
        }
        if (body.has_target)
        {
            add(h, state.targets[static_cast<std::size_t>(i)].center);
            add(h, state.targets[static_cast<std::size_t>(i)].rotation);
        }
        if (const auto index = static_cast<std::size_t>(i);
            index < state.waiting_forces.size() && state.waiting_forces[index] != WaitingForce{})
        {
            add(h, state.waiting_forces[index].impulse);
            h.add(state.waiting_forces[index].twist);
        }
    }
    for (int i = 0; i < state.shapes.capacity(); ++i)
    {
        if (state.shapes.is_live(i))
            add_shape(h, state, i);
    }
    for (int i = 0; i < state.contacts.capacity(); ++i)
    {
        if (state.contacts.is_live(i))
            add_contact(h, state, i);
    }
    for (int i = 0; i < state.joints.capacity(); ++i)
    {
        if (state.joints.is_live(i))
            add_joint(h, state.joints[i]);
    }
    for (const std::int32_t body : state.awake_bodies)
        h.add(body);
    for (const std::int32_t contact : state.awake_contacts)
        h.add(contact);
    return h.value();
}

} // namespace carom
