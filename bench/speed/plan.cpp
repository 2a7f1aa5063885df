#include "speed/plan.h"

#include <algorithm>

namespace speed {
namespace {

using truth::Missing;
using truth::Vec;

truth::Motion motion(carom::BodyType type)
{
    switch (type)
    {
    case carom::BodyType::Static: return truth::Motion::Static;
    case carom::BodyType::Kinematic: return truth::Motion::Kinematic;
    case carom::BodyType::Dynamic: break;
    }
    return truth::Motion::Dynamic;
}

truth::Filter filter(const carom::Filter& f)
{
    if (f.group > 0)
        throw Missing("groups that always touch");
    return {static_cast<std::uint32_t>(f.category), static_cast<std::uint32_t>(f.mask), f.group};
}

truth::Material material(const carom::ShapeDef& def)
{
    if (def.trigger || def.restitution_curve.count > 0 || def.kick.speed > 0 || def.one_way != carom::Vec2{} ||
        def.rolling_resistance > 0 || def.surface_speed != 0)
        throw Missing("triggers, kicks, one-way shapes, curves, belts and rolling resistance");
    return {.density = def.density, .restitution = def.restitution, .friction = def.friction, .filter = filter(def.filter)};
}

std::vector<Vec> counter_clockwise(const std::vector<carom::Vec2>& corners)
{
    std::vector<Vec> result;
    double twice_area = 0;
    for (std::size_t i = 0; i < corners.size(); ++i)
    {
        result.push_back(widen(corners[i]));
        twice_area += cross(widen(corners[i]), widen(corners[(i + 1) % corners.size()]));
    }
    if (twice_area < 0)
        std::reverse(result.begin(), result.end());
    return result;
}

/// Adds one shape to a plan.
struct ShapePlanner
{
    BodyPlan& plan;
    truth::Material material;

    void add(const truth::Shape& shape) const { plan.shapes.emplace_back(shape, material); }
    void operator()(const carom::Circle& circle) const { add(truth::Disc{circle.radius, widen(circle.center)}); }
    void operator()(const carom::Polygon& polygon) const
    {
        add(truth::Polygon{counter_clockwise(polygon.vertices), polygon.radius});
    }
    void operator()(const carom::Capsule& capsule) const
    {
        if (capsule.radius_a != capsule.radius_b)
            throw Missing("tapered capsules");
        add(truth::Capsule{widen(capsule.a), widen(capsule.b), capsule.radius_a});
    }
    void operator()(const carom::Segment& segment) const
    {
        if (segment.half_thickness > 0 || segment.sides != carom::Sides::Both)
            throw Missing("thick and one-sided segments");
        add(truth::Segment{widen(segment.a), widen(segment.b)});
    }
    void operator()(const carom::Chain& chain) const
    {
        const bool straight = std::ranges::all_of(chain.pieces, [](const carom::ChainPiece& p) { return p.sweep == 0; });
        if (!chain.closed || !straight || chain.half_thickness > 0 || chain.sides != carom::Sides::Left)
            throw Missing("chains but closed straight ones, solid to what is inside");
        std::vector<carom::Vec2> corners{chain.start};
        for (const carom::ChainPiece& piece : chain.pieces)
            corners.push_back(piece.end);
        if (corners.back() == corners.front())
            corners.pop_back();
        plan.rings.emplace_back(counter_clockwise(corners), material);
    }
    void operator()(const carom::Arc&) const { throw Missing("arcs"); }
    void operator()(const carom::HalfSpace&) const { throw Missing("half-spaces"); }
};

truth::Hinge plan_hinge(const carom::ConstJoint& joint, const Translator& numbers)
{
    const carom::JointDef any = joint.def();
    const carom::RevoluteDef* def = std::get_if<carom::RevoluteDef>(&any);
    if (def == nullptr || def->collide_connected || def->spring_angle != 0)
        throw Missing("joints but hinges whose bodies pass through each other");
    return {.a = numbers.number(def->body_a),
            .b = numbers.number(def->body_b),
            .anchor = widen(joint.anchor_b()),
            .reference = def->reference_angle,
            .limited = def->enable_limit,
            .lower = def->lower_angle,
            .upper = def->upper_angle,
            .driven = def->enable_motor,
            .motor_speed = def->motor_speed,
            .motor_torque = def->max_motor_torque,
            .hertz = def->spring_hertz,
            .damping_ratio = def->spring_damping_ratio};
}

} // namespace

BodyPlan plan_body(const carom::ConstBody& body, const carom::Scene& scene)
{
    BodyPlan plan{.def = {.motion = motion(body.type()),
                          .position = widen(body.position()),
                          .angle = body.angle(),
                          .velocity = widen(body.velocity()),
                          .spin = body.angular_velocity(),
                          .damping = body.linear_damping(),
                          .awake = body.type() != carom::BodyType::Dynamic || body.is_awake(),
                          .can_sleep = body.can_sleep(),
                          .sleep_speed = body.sleep_speed()}};
    for (const carom::ShapeId id : body.shapes())
        std::visit(ShapePlanner{plan, material(scene.shape(id).def())}, scene.shape(id).geometry());
    return plan;
}

void BodyPlan::make(truth::World& world) const
{
    const truth::Body body = world.add_body(def);
    for (const auto& [shape, material] : shapes)
        world.add_shape(body, shape, material);
    for (const auto& [corners, material] : rings)
        world.add_ring(body, corners, material);
}

void Changes::make(truth::World& world) const
{
    for (const truth::Body body : gone)
        world.remove_body(body);
    for (const BodyPlan& body : bodies)
        body.make(world);
    for (const truth::Hinge& hinge : hinges)
        world.add_hinge(hinge);
}

void Translator::look_for_gone(const carom::Scene& scene, Changes& changes)
{
    std::erase_if(m_joints, [&](const auto& known) { return !scene.is_valid(known.first); });
    for (auto it = m_bodies.begin(); it != m_bodies.end();)
    {
        if (scene.is_valid(it->first))
        {
            ++it;
            continue;
        }
        changes.gone.push_back(it->second);
        it = m_bodies.erase(it);
    }
}

Changes Translator::look(const carom::Scene& scene)
{
    Changes changes;
    look_for_gone(scene, changes);
    for (const carom::BodyId id : scene.bodies())
        if (m_bodies.emplace(id, m_next).second)
        {
            changes.bodies.push_back(plan_body(scene.body(id), scene));
            ++m_next;
        }
    for (const carom::JointId id : scene.joints())
        if (m_joints.emplace(id, true).second)
            changes.hinges.push_back(plan_hinge(scene.joint(id), *this));
    return changes;
}

} // namespace speed
