#include "truth/engines/engines.h"
#include "truth/engines/facets.h"

#include <box2d/box2d.h>

#include <algorithm>
#include <utility>

namespace truth {
namespace {

b2Vec2 narrow(Vec v) { return {static_cast<float>(v.x), static_cast<float>(v.y)}; }

b2BodyType body_type(Motion motion)
{
    switch (motion)
    {
    case Motion::Static: return b2_staticBody;
    case Motion::Kinematic: return b2_kinematicBody;
    case Motion::Dynamic: break;
    }
    return b2_dynamicBody;
}

/// Makes one fixture from a shape.
struct Fixtures
{
    b2Body* body;
    b2FixtureDef def;

    void add(const b2Shape& shape) const
    {
        b2FixtureDef complete = def;
        complete.shape = &shape;
        body->CreateFixture(&complete);
    }
    void operator()(const Disc& disc) const
    {
        b2CircleShape circle;
        circle.m_radius = static_cast<float>(disc.radius);
        circle.m_p = narrow(disc.center);
        add(circle);
    }
    void operator()(const Polygon& polygon) const
    {
        std::vector<b2Vec2> vertices;
        const std::vector<Vec> outline = polygon.radius > 0 ? grown(polygon) : polygon.vertices;
        std::transform(outline.begin(), outline.end(), std::back_inserter(vertices), narrow);
        b2PolygonShape shape;
        shape.Set(vertices.data(), static_cast<int32>(vertices.size()));
        add(shape);
    }
    void operator()(const Segment& segment) const
    {
        b2EdgeShape edge;
        edge.SetTwoSided(narrow(segment.a), narrow(segment.b));
        add(edge);
    }
    // It has no capsules.
    void operator()(const Capsule& capsule) const { (*this)(facets(capsule)); }
};

/// Counts what comes into and goes out of sensors.
class SensorListener final : public b2ContactListener
{
public:
    void BeginContact(b2Contact* contact) override { note(contact, true); }
    void EndContact(b2Contact* contact) override { note(contact, false); }
    std::vector<Crossing> crossings{};

private:
    void note(b2Contact* contact, bool enter)
    {
        if (contact->GetFixtureA()->IsSensor() || contact->GetFixtureB()->IsSensor())
        {
            crossings.push_back({enter, 0});
        }
    }
};

class Box2dWorld final : public World
{
public:
    explicit Box2dWorld(const WorldDef& def) : m_world(narrow(def.gravity))
    {
        m_world.SetAllowSleeping(def.sleeping);
        m_world.SetContinuousPhysics(def.continuous);
        m_world.SetContactListener(&m_sensors);
        const b2BodyDef ground_def;
        m_ground = m_world.CreateBody(&ground_def);
    }

    Body add_body(const BodyDef& def) override
    {
        b2BodyDef made;
        made.type = body_type(def.motion);
        made.position = narrow(def.position);
        made.angle = static_cast<float>(def.angle);
        made.linearVelocity = narrow(def.velocity);
        made.angularVelocity = static_cast<float>(def.spin);
        made.linearDamping = static_cast<float>(def.damping);
        made.awake = def.awake;
        made.allowSleep = def.can_sleep;
        m_bodies.push_back(m_world.CreateBody(&made));
        return static_cast<Body>(m_bodies.size()) - 1;
    }

    void add_shape(Body body, const Shape& shape, const Material& material) override
    {
        std::visit(Fixtures{find(body), fixture_def(material)}, shape);
    }

    // Its chains are solid on their right.
    void add_ring(Body body, const std::vector<Vec>& corners, const Material& material) override
    {
        std::vector<b2Vec2> vertices;
        std::transform(corners.rbegin(), corners.rend(), std::back_inserter(vertices), narrow);
        b2ChainShape chain;
        chain.CreateLoop(vertices.data(), static_cast<int32>(vertices.size()));
        Fixtures{find(body), fixture_def(material)}.add(chain);
    }

    // It has no spring in a hinge.
    void add_hinge(const Hinge& hinge) override
    {
        b2RevoluteJointDef def;
        def.Initialize(find(hinge.a), find(hinge.b), narrow(hinge.anchor));
        def.referenceAngle = static_cast<float>(hinge.reference);
        def.enableLimit = hinge.limited;
        def.lowerAngle = static_cast<float>(hinge.lower);
        def.upperAngle = static_cast<float>(hinge.upper);
        def.enableMotor = hinge.driven;
        def.motorSpeed = static_cast<float>(hinge.motor_speed);
        def.maxMotorTorque = static_cast<float>(hinge.motor_torque);
        m_hinges.push_back(m_world.CreateJoint(&def));
    }

    void add_slider(const Slider& slider) override
    {
        b2PrismaticJointDef def;
        def.Initialize(find(slider.a), find(slider.b), narrow(slider.anchor), narrow(slider.axis));
        def.enableLimit = slider.limited;
        def.lowerTranslation = static_cast<float>(slider.lower);
        def.upperTranslation = static_cast<float>(slider.upper);
        m_world.CreateJoint(&def);
    }

    void add_rod(Body a, Body b, double length) override
    {
        b2DistanceJointDef def;
        def.Initialize(find(a), find(b), find(a)->GetPosition(), find(b)->GetPosition());
        def.length = def.minLength = def.maxLength = static_cast<float>(length);
        m_world.CreateJoint(&def);
    }

    Vec hinge_force(int hinge) const override
    {
        const b2Vec2 force = m_hinges[static_cast<std::size_t>(hinge)]->GetReactionForce(m_rate);
        return {force.x, force.y};
    }

    void add_spring(Body a, Body b, double length, double stiffness, double damping) override
    {
        b2DistanceJointDef def;
        def.Initialize(find(a), find(b), find(a)->GetPosition(), find(b)->GetPosition());
        def.length = static_cast<float>(length);
        def.minLength = 0;
        def.maxLength = 1000;
        def.stiffness = static_cast<float>(stiffness);
        def.damping = static_cast<float>(damping);
        def.collideConnected = true;
        m_world.CreateJoint(&def);
    }

    void remove_body(Body body) override
    {
        m_world.DestroyBody(find(body));
        m_bodies[static_cast<std::size_t>(body)] = nullptr;
    }

    int contacts() const override { return m_world.GetContactCount(); }

    void set_motion(Body body, Vec velocity, double spin) override
    {
        find(body)->SetLinearVelocity(narrow(velocity));
        find(body)->SetAngularVelocity(static_cast<float>(spin));
    }

    // 8 and 3 are the iterations its manual suggests.
    void step(double dt) override
    {
        m_sensors.crossings.clear();
        m_rate = static_cast<float>(1 / dt);
        m_world.Step(static_cast<float>(dt), 8, 3);
    }

    State state(Body body) const override
    {
        const b2Body* b = find(body);
        const b2Vec2 at = b->GetPosition();
        const b2Vec2 velocity = b->GetLinearVelocity();
        return {{at.x, at.y}, b->GetAngle(), {velocity.x, velocity.y}, b->GetAngularVelocity(), b->IsAwake()};
    }

    std::vector<Crossing> crossings() const override { return m_sensors.crossings; }

private:
    static b2FixtureDef fixture_def(const Material& material)
    {
        b2FixtureDef def;
        def.density = static_cast<float>(material.density);
        def.friction = static_cast<float>(material.friction);
        def.restitution = static_cast<float>(material.restitution);
        def.isSensor = material.sensor;
        def.filter.categoryBits = static_cast<uint16>(material.filter.category);
        def.filter.maskBits = static_cast<uint16>(material.filter.mask);
        def.filter.groupIndex = static_cast<int16>(material.filter.group);
        return def;
    }
    b2Body* find(Body body) const { return body == ground ? m_ground : m_bodies[static_cast<std::size_t>(body)]; }

    SensorListener m_sensors{};
    b2World m_world;
    b2Body* m_ground = nullptr;
    std::vector<b2Body*> m_bodies{};
    std::vector<b2Joint*> m_hinges{};
    float m_rate = 0;
};

} // namespace

// The library's own b2_version of 2.4.1 says 2.4.0: the name comes from the package.
Engine box2d_engine()
{
    return {.name = "Box2D " TRUTH_HAS_BOX2D,
            .make_world = [](const WorldDef& def) { return std::make_unique<Box2dWorld>(def); },
            .peer = true,
            .key = "box2d24"};
}

} // namespace truth
