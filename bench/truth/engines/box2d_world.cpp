#include "truth/engines/engines.h"

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
        add(circle);
    }
    void operator()(const Polygon& polygon) const
    {
        std::vector<b2Vec2> vertices;
        std::transform(polygon.vertices.begin(), polygon.vertices.end(), std::back_inserter(vertices), narrow);
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
    explicit Box2dWorld(Vec gravity) : m_world(narrow(gravity))
    {
        m_world.SetAllowSleeping(false);
        m_world.SetContactListener(&m_sensors);
        const b2BodyDef def;
        m_ground = m_world.CreateBody(&def);
    }

    Body add_body(const BodyDef& def) override
    {
        b2BodyDef made;
        made.type = body_type(def.motion);
        made.position = narrow(def.position);
        made.angle = static_cast<float>(def.angle);
        made.linearVelocity = narrow(def.velocity);
        made.angularVelocity = static_cast<float>(def.spin);
        m_bodies.push_back(m_world.CreateBody(&made));
        return static_cast<Body>(m_bodies.size()) - 1;
    }

    void add_shape(Body body, const Shape& shape, const Material& material) override
    {
        b2FixtureDef def;
        def.density = static_cast<float>(material.density);
        def.friction = static_cast<float>(material.friction);
        def.restitution = static_cast<float>(material.restitution);
        def.isSensor = material.sensor;
        def.filter.groupIndex = static_cast<int16>(material.collides ? 0 : -1);
        std::visit(Fixtures{find(body), def}, shape);
    }

    void add_hinge(Body a, Body b, Vec anchor) override
    {
        b2RevoluteJointDef def;
        def.Initialize(find(a), find(b), narrow(anchor));
        m_world.CreateJoint(&def);
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

    void set_motion(Body body, Vec velocity, double spin) override
    {
        find(body)->SetLinearVelocity(narrow(velocity));
        find(body)->SetAngularVelocity(static_cast<float>(spin));
    }

    // 8 and 3 are the iterations its manual suggests.
    void step(double dt) override
    {
        m_sensors.crossings.clear();
        m_world.Step(static_cast<float>(dt), 8, 3);
    }

    State state(Body body) const override
    {
        const b2Body* b = find(body);
        const b2Vec2 at = b->GetPosition();
        const b2Vec2 velocity = b->GetLinearVelocity();
        return {{at.x, at.y}, b->GetAngle(), {velocity.x, velocity.y}, b->GetAngularVelocity()};
    }

    std::vector<Crossing> crossings() const override { return m_sensors.crossings; }

private:
    b2Body* find(Body body) const { return body == ground ? m_ground : m_bodies[static_cast<std::size_t>(body)]; }

    SensorListener m_sensors{};
    b2World m_world;
    b2Body* m_ground = nullptr;
    std::vector<b2Body*> m_bodies{};
};

} // namespace

// The library's own b2_version of 2.4.1 says 2.4.0: the name comes from the package.
Engine box2d_engine()
{
    return {"Box2D " TRUTH_HAS_BOX2D, [](Vec gravity) { return std::make_unique<Box2dWorld>(gravity); }, true};
}

} // namespace truth
