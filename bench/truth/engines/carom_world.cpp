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
    carom::Geometry operator()(const Disc& disc) const { return carom::Circle{.radius = static_cast<float>(disc.radius)}; }
    carom::Geometry operator()(const Polygon& polygon) const
    {
        carom::Polygon result;
        std::transform(polygon.vertices.begin(), polygon.vertices.end(), std::back_inserter(result.vertices), narrow);
        return result;
    }
    carom::Geometry operator()(const Segment& segment) const
    {
        return carom::Segment{.a = narrow(segment.a), .b = narrow(segment.b)};
    }
};

carom::ShapeDef shape_def(const Material& material)
{
    return {.density = static_cast<float>(material.density),
            .friction = static_cast<float>(material.friction),
            .restitution = static_cast<float>(material.restitution),
            .filter = {.group = material.collides ? 0 : -1},
            .trigger = material.sensor};
}

// Every setting is the default but gravity; sleeping is off for every engine, so that nothing stops by decree.
class CaromWorld final : public World
{
public:
    explicit CaromWorld(Vec gravity) : m_scene({.gravity = narrow(gravity), .sleeping = false}) {}

    Body add_body(const BodyDef& def) override
    {
        m_bodies.push_back(m_scene.create_body({.type = body_type(def.motion),
                                                .position = position(def.position),
                                                .angle = static_cast<float>(def.angle),
                                                .velocity = narrow(def.velocity),
                                                .angular_velocity = static_cast<float>(def.spin),
                                                .user_data = m_bodies.size()}));
        return static_cast<Body>(m_bodies.size()) - 1;
    }

    void add_shape(Body body, const Shape& shape, const Material& material) override
    {
        m_scene.create_shape(id(body), std::visit(ToGeometry{}, shape), shape_def(material));
    }

    void add_hinge(Body a, Body b, Vec anchor) override
    {
        m_scene.create_joint(
            carom::RevoluteDef{.body_a = id(a), .body_b = id(b), .anchor_a = local(a, anchor), .anchor_b = local(b, anchor)});
    }

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
        return {{at.x, at.y}, reference.angle(), widen(reference.velocity()), reference.angular_velocity()};
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
};

} // namespace

Engine carom_engine()
{
    return {"Carom", [](Vec gravity) { return std::make_unique<CaromWorld>(gravity); }};
}

} // namespace truth
