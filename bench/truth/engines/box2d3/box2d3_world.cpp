#include "truth/engines/engines.h"

#include <box2d/box2d.h>
#include <box2d/constants.h>

#include <algorithm>
#include <cmath>

namespace truth {
namespace {

float narrow(double value) { return static_cast<float>(value); }
b2Vec2 narrow(Vec v) { return {narrow(v.x), narrow(v.y)}; }
b2Pos position(Vec v) { return {narrow(v.x), narrow(v.y)}; }

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

b2Filter filter(const Filter& f)
{
    // A mask of 32 ones means everything.
    const std::uint64_t high = f.mask == ~std::uint32_t{0} ? ~std::uint64_t{0} << 32 : 0;
    return {f.category, high | f.mask, f.group};
}

b2ShapeDef shape_def(const Material& material)
{
    b2ShapeDef def = b2DefaultShapeDef();
    def.density = narrow(material.density);
    def.material.friction = narrow(material.friction);
    def.material.restitution = narrow(material.restitution);
    def.filter = filter(material.filter);
    def.isSensor = material.sensor;
    def.enableSensorEvents = true;
    return def;
}

/// Makes one shape.
struct Shapes
{
    b2BodyId body;
    b2ShapeDef def;

    void operator()(const Disc& disc) const
    {
        const b2Circle circle{narrow(disc.center), narrow(disc.radius)};
        b2CreateCircleShape(body, &def, &circle);
    }
    void operator()(const Polygon& polygon) const
    {
        if (polygon.vertices.size() > B2_MAX_POLYGON_VERTICES)
        {
            throw Missing("polygons of so many corners");
        }
        b2Vec2 corners[B2_MAX_POLYGON_VERTICES];
        std::transform(polygon.vertices.begin(), polygon.vertices.end(), corners, [](Vec v) { return narrow(v); });
        const b2Hull hull = b2ComputeHull(corners, static_cast<int>(polygon.vertices.size()));
        const b2Polygon made = b2MakePolygon(&hull, narrow(polygon.radius));
        b2CreatePolygonShape(body, &def, &made);
    }
    void operator()(const Segment& segment) const
    {
        const b2Segment made{narrow(segment.a), narrow(segment.b)};
        b2CreateSegmentShape(body, &def, &made);
    }
    void operator()(const Capsule& capsule) const
    {
        const b2Capsule made{narrow(capsule.a), narrow(capsule.b), narrow(capsule.radius)};
        b2CreateCapsuleShape(body, &def, &made);
    }
};

class Box2d3World final : public World
{
public:
    explicit Box2d3World(const WorldDef& def) : m_substeps(def.substeps)
    {
        b2WorldDef made = b2DefaultWorldDef();
        made.gravity = narrow(def.gravity);
        made.enableSleep = def.sleeping;
        made.enableContinuous = def.continuous;
        made.workerCount = def.threads;
        m_world = b2CreateWorld(&made);
    }
    ~Box2d3World() override { b2DestroyWorld(m_world); }
    Box2d3World(const Box2d3World&) = delete;
    Box2d3World& operator=(const Box2d3World&) = delete;

    Body add_body(const BodyDef& def) override
    {
        b2BodyDef made = b2DefaultBodyDef();
        made.type = body_type(def.motion);
        made.position = position(def.position);
        made.rotation = b2MakeRot(narrow(def.angle));
        made.linearVelocity = narrow(def.velocity);
        made.angularVelocity = narrow(def.spin);
        made.linearDamping = narrow(def.damping);
        made.isAwake = def.awake;
        made.enableSleep = def.can_sleep;
        made.sleepThreshold = narrow(def.sleep_speed);
        m_bodies.push_back(b2CreateBody(m_world, &made));
        return static_cast<Body>(m_bodies.size()) - 1;
    }

    void add_shape(Body body, const Shape& shape, const Material& material) override
    {
        std::visit(Shapes{find(body), shape_def(material)}, shape);
    }

    // Its chains are solid on their right.
    void add_ring(Body body, const std::vector<Vec>& corners, const Material& material) override
    {
        std::vector<b2Vec2> points;
        std::transform(corners.rbegin(), corners.rend(), std::back_inserter(points), [](Vec v) { return narrow(v); });
        std::rotate(points.begin(), points.end() - 1, points.end());
        const b2ShapeDef like = shape_def(material);
        b2ChainDef def = b2DefaultChainDef();
        def.points = points.data();
        def.count = static_cast<int>(points.size());
        def.isLoop = true;
        def.materials = &like.material;
        def.materialCount = 1;
        def.filter = like.filter;
        b2CreateChain(find(body), &def);
    }

    void add_hinge(const Hinge& hinge) override
    {
        b2RevoluteJointDef def = b2DefaultRevoluteJointDef();
        join(def.base, hinge.a, hinge.b);
        def.base.localFrameA = {b2Body_GetLocalPoint(find(hinge.a), position(hinge.anchor)), b2MakeRot(narrow(hinge.reference))};
        def.base.localFrameB.p = b2Body_GetLocalPoint(find(hinge.b), position(hinge.anchor));
        def.enableLimit = hinge.limited;
        def.lowerAngle = narrow(hinge.lower);
        def.upperAngle = narrow(hinge.upper);
        def.enableMotor = hinge.driven;
        def.motorSpeed = narrow(hinge.motor_speed);
        def.maxMotorTorque = narrow(hinge.motor_torque);
        def.enableSpring = hinge.hertz > 0;
        def.hertz = narrow(hinge.hertz);
        def.dampingRatio = narrow(hinge.damping_ratio);
        m_hinges.push_back(b2CreateRevoluteJoint(m_world, &def));
    }

    void add_slider(const Slider& slider) override
    {
        b2PrismaticJointDef def = b2DefaultPrismaticJointDef();
        join(def.base, slider.a, slider.b);
        def.base.localFrameA = frame(slider.a, slider.anchor, slider.axis);
        def.base.localFrameB = frame(slider.b, slider.anchor, slider.axis);
        def.enableLimit = slider.limited;
        def.lowerTranslation = narrow(slider.lower);
        def.upperTranslation = narrow(slider.upper);
        b2CreatePrismaticJoint(m_world, &def);
    }

    void add_rod(Body a, Body b, double length) override
    {
        b2DistanceJointDef def = b2DefaultDistanceJointDef();
        join(def.base, a, b);
        def.length = narrow(length);
        b2CreateDistanceJoint(m_world, &def);
    }

    Vec hinge_force(int hinge) const override
    {
        const b2Vec2 force = b2Joint_GetConstraintForce(m_hinges[static_cast<std::size_t>(hinge)]);
        return {static_cast<double>(force.x), static_cast<double>(force.y)};
    }

    // It counts in frequency and damping ratio.
    void add_spring(Body a, Body b, double length, double stiffness, double damping) override
    {
        const double mass = 1 / (inverse_mass(a) + inverse_mass(b));
        const double w = std::sqrt(stiffness / mass);
        b2DistanceJointDef def = b2DefaultDistanceJointDef();
        join(def.base, a, b);
        def.base.collideConnected = true;
        def.length = narrow(length);
        def.enableSpring = true;
        def.hertz = narrow(w / (2 * pi));
        def.dampingRatio = narrow(damping / (2 * mass * w));
        b2CreateDistanceJoint(m_world, &def);
    }

    void remove_body(Body body) override { b2DestroyBody(find(body)); }
    int contacts() const override { return b2World_GetCounters(m_world).contactCount; }

    void set_motion(Body body, Vec velocity, double spin) override
    {
        b2Body_SetLinearVelocity(find(body), narrow(velocity));
        b2Body_SetAngularVelocity(find(body), narrow(spin));
    }

    void step(double dt) override { b2World_Step(m_world, narrow(dt), m_substeps); }

    State state(Body body) const override
    {
        const b2BodyId id = m_bodies[static_cast<std::size_t>(body)];
        const b2Pos at = b2Body_GetPosition(id);
        const b2Rot turn = b2Body_GetRotation(id);
        const b2Vec2 velocity = b2Body_GetLinearVelocity(id);
        const auto widen = [](auto value) { return static_cast<double>(value); };
        return {{widen(at.x), widen(at.y)},
                std::atan2(widen(turn.s), widen(turn.c)),
                {widen(velocity.x), widen(velocity.y)},
                widen(b2Body_GetAngularVelocity(id)),
                b2Body_IsAwake(id)};
    }

    std::vector<Crossing> crossings() const override
    {
        const b2SensorEvents events = b2World_GetSensorEvents(m_world);
        std::vector<Crossing> list(static_cast<std::size_t>(events.beginCount), {true, 0});
        list.insert(list.end(), static_cast<std::size_t>(events.endCount), {false, 0});
        return list;
    }

private:
    // The world as a party of a joint is a body like others, made where it is needed.
    b2BodyId find(Body body)
    {
        if (body != ground)
        {
            return m_bodies[static_cast<std::size_t>(body)];
        }
        if (B2_IS_NULL(m_ground))
        {
            const b2BodyDef def = b2DefaultBodyDef();
            m_ground = b2CreateBody(m_world, &def);
        }
        return m_ground;
    }
    void join(b2JointDef& def, Body a, Body b)
    {
        def.bodyIdA = find(a);
        def.bodyIdB = find(b);
    }
    b2Transform frame(Body body, Vec anchor, Vec axis)
    {
        const b2Vec2 along = b2Body_GetLocalVector(find(body), narrow(axis));
        return {b2Body_GetLocalPoint(find(body), position(anchor)), {along.x, along.y}};
    }
    double inverse_mass(Body body)
    {
        const auto mass = static_cast<double>(b2Body_GetMass(find(body)));
        return mass > 0 ? 1 / mass : 0;
    }

    b2WorldId m_world{};
    b2BodyId m_ground = b2_nullBodyId;
    std::vector<b2BodyId> m_bodies{};
    std::vector<b2JointId> m_hinges{};
    int m_substeps;
};

} // namespace

Engine box2d3_engine()
{
    return {.name = "Box2D " TRUTH_BOX2D3,
            .make_world = [](const WorldDef& def) { return std::make_unique<Box2d3World>(def); },
            .peer = true,
            .key = "box2d3",
            .most_threads = B2_MAX_WORKERS};
}

} // namespace truth
