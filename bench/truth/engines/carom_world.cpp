#include "truth/engines/engines.h"

#include "carom/carom.h"

#include <algorithm>

namespace truth {
namespace {

carom::Vec2 narrow(Vec v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }
carom::Position position(Vec v) { return {v.x, v.y}; }
Vec widen(carom::Vec2 v) { return {v.x, v.y}; }

carom::BodyType body_type(Motion motion)
{
    switch (motion)
    {
    case Motion::Static: return carom::BodyType::Static;
    case Motion::Kinematic: return carom::BodyType::Kinematic;
    case Motion::Dynamic: break;
    }
    return carom::BodyType::Dynamic;
}

struct ToGeometry
{
    carom::Geometry operator()(const Disc& disc) const
    {
        return carom::Circle{.center = narrow(disc.center), .radius = static_cast<float>(disc.radius)};
    }
    carom::Geometry operator()(const Polygon& polygon) const
    {
        carom::Polygon result{.radius = static_cast<float>(polygon.radius)};
        std::transform(polygon.vertices.begin(), polygon.vertices.end(), std::back_inserter(result.vertices), narrow);
        return result;
    }
    carom::Geometry operator()(const Segment& segment) const
    {
        return carom::Segment{.a = narrow(segment.a), .b = narrow(segment.b)};
    }
    carom::Geometry operator()(const Capsule& capsule) const
    {
        const auto radius = static_cast<float>(capsule.radius);
        return carom::Capsule{narrow(capsule.a), narrow(capsule.b), radius, radius};
    }
};

carom::ShapeDef shape_def(const Material& material)
{
    return {.density = static_cast<float>(material.density),
            .friction = static_cast<float>(material.friction),
            .restitution = static_cast<float>(material.restitution),
            .filter = {.category = material.filter.category, .mask = material.filter.mask, .group = material.filter.group},
            .trigger = material.sensor};
}

// Every setting is the default but those that every engine is given.
class CaromWorld final : public World
{
public:
    CaromWorld(const WorldDef& def, int most_subdivisions)
        : m_scene({.gravity = narrow(def.gravity),
                   .substeps = def.substeps,
                   .most_subdivisions = most_subdivisions,
                   .sleeping = def.sleeping,
                   .continuous = def.continuous})
    {}

    Body add_body(const BodyDef& def) override
    {
        m_bodies.push_back(m_scene.create_body({.type = body_type(def.motion),
                                                .position = position(def.position),
                                                .angle = static_cast<float>(def.angle),
                                                .velocity = narrow(def.velocity),
                                                .angular_velocity = static_cast<float>(def.spin),
                                                .linear_damping = static_cast<float>(def.damping),
                                                .awake = def.awake,
                                                .can_sleep = def.can_sleep,
                                                .sleep_speed = static_cast<float>(def.sleep_speed),
                                                .user_data = m_bodies.size()}));
        return static_cast<Body>(m_bodies.size()) - 1;
    }

    void add_shape(Body body, const Shape& shape, const Material& material) override
    {
        m_scene.create_shape(id(body), std::visit(ToGeometry{}, shape), shape_def(material));
    }

    void add_hinge(const Hinge& hinge) override
    {
        m_hinges.push_back(
            m_scene.create_joint(carom::RevoluteDef{.body_a = id(hinge.a),
                                                    .body_b = id(hinge.b),
                                                    .anchor_a = local(hinge.a, hinge.anchor),
                                                    .anchor_b = local(hinge.b, hinge.anchor),
                                                    .reference_angle = static_cast<float>(hinge.reference),
                                                    .enable_limit = hinge.limited,
                                                    .lower_angle = static_cast<float>(hinge.lower),
                                                    .upper_angle = static_cast<float>(hinge.upper),
                                                    .enable_motor = hinge.driven,
                                                    .motor_speed = static_cast<float>(hinge.motor_speed),
                                                    .max_motor_torque = static_cast<float>(hinge.motor_torque),
                                                    .spring_hertz = static_cast<float>(hinge.hertz),
                                                    .spring_damping_ratio = static_cast<float>(hinge.damping_ratio)}));
    }

    void add_slider(const Slider& slider) override
    {
        const double turn = slider.a == ground ? 0 : state(slider.a).angle;
        const double turn_b = slider.b == ground ? 0 : state(slider.b).angle;
        m_scene.create_joint(carom::PrismaticDef{.body_a = id(slider.a),
                                                 .body_b = id(slider.b),
                                                 .anchor_a = local(slider.a, slider.anchor),
                                                 .anchor_b = local(slider.b, slider.anchor),
                                                 .axis_a = narrow(rotate(-turn, slider.axis)),
                                                 .reference_angle = static_cast<float>(turn_b - turn),
                                                 .enable_limit = slider.limited,
                                                 .lower_translation = static_cast<float>(slider.lower),
                                                 .upper_translation = static_cast<float>(slider.upper),
                                                 .limit_restitution = static_cast<float>(slider.restitution)});
    }

    void add_rod(Body a, Body b, double length) override
    {
        m_scene.create_joint(carom::DistanceDef{.body_a = id(a),
                                                .body_b = id(b),
                                                .min_length = static_cast<float>(length),
                                                .max_length = static_cast<float>(length)});
    }

    Vec hinge_force(int hinge) const override { return widen(m_scene.joint(m_hinges[static_cast<std::size_t>(hinge)]).force()); }

    void add_spring(Body a, Body b, double length, double stiffness, double damping) override
    {
        m_scene.create_joint(carom::SpringDef{.body_a = id(a),
                                              .body_b = id(b),
                                              .stiffness = static_cast<float>(stiffness),
                                              .damping = static_cast<float>(damping),
                                              .length = static_cast<float>(length)});
    }

    void set_motion(Body body, Vec velocity, double spin) override
    {
        m_scene.body(id(body)).set_velocity(narrow(velocity));
        m_scene.body(id(body)).set_angular_velocity(static_cast<float>(spin));
    }

    void step(double dt) override { m_scene.step(static_cast<float>(dt)); }

    State state(Body body) const override
    {
        const carom::ConstBody reference = m_scene.body(id(body));
        const carom::Position at = reference.position();
        return {{at.x, at.y}, reference.angle(), widen(reference.velocity()), reference.angular_velocity(), reference.is_awake()};
    }

    bool reports_impacts() const override { return true; }
    std::vector<Impact> impacts() const override
    {
        std::vector<Impact> result;
        for (const carom::ImpactEvent& event : m_scene.impacts())
        {
            result.push_back({index(event.body_a), index(event.body_b), event.time, event.approach_speed});
        }
        return result;
    }

    bool crossing_times() const override { return true; }
    std::vector<Crossing> crossings() const override
    {
        std::vector<Crossing> result;
        for (const carom::TriggerEvent& event : m_scene.trigger_enters())
        {
            result.push_back({true, event.time});
        }
        for (const carom::TriggerEvent& event : m_scene.trigger_exits())
        {
            result.push_back({false, event.time});
        }
        return result;
    }

private:
    carom::BodyId id(Body body) const { return body == ground ? carom::BodyId{} : m_bodies[static_cast<std::size_t>(body)]; }
    Body index(carom::BodyId body) const { return static_cast<Body>(m_scene.body(body).user_data()); }
    carom::Vec2 local(Body body, Vec point) const
    {
        return body == ground ? narrow(point) : m_scene.body(id(body)).local_point(position(point));
    }

    carom::Scene m_scene;
    std::vector<carom::BodyId> m_bodies{};
    std::vector<carom::JointId> m_hinges{};
};

} // namespace

Engine carom_engine(int most_subdivisions)
{
    return {.name = "Carom",
            .make_world = [=](const WorldDef& def) { return std::make_unique<CaromWorld>(def, most_subdivisions); },
            .key = "carom"};
}

} // namespace truth
