#include "truth/engines/engines.h"

#include <chipmunk/chipmunk.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace truth {
namespace {

cpVect vect(Vec v) { return cpv(v.x, v.y); }
Vec from(cpVect v) { return {v.x, v.y}; }

cpBody* make_body(Motion motion)
{
    switch (motion)
    {
    case Motion::Static: return cpBodyNewStatic();
    case Motion::Kinematic: return cpBodyNewKinematic();
    case Motion::Dynamic: break;
    }
    return cpBodyNew(0, 0); // mass and inertia come from its shapes
}

struct ToShape
{
    cpBody* body;

    cpShape* operator()(const Disc& disc) const { return cpCircleShapeNew(body, disc.radius, cpvzero); }
    cpShape* operator()(const Segment& segment) const { return cpSegmentShapeNew(body, vect(segment.a), vect(segment.b), 0); }
    cpShape* operator()(const Polygon& polygon) const
    {
        std::vector<cpVect> vertices;
        std::transform(polygon.vertices.begin(), polygon.vertices.end(), std::back_inserter(vertices), vect);
        return cpPolyShapeNewRaw(body, static_cast<int>(vertices.size()), vertices.data(), 0);
    }
};

constexpr cpCollisionType sensor_type = 1;

class ChipmunkWorld final : public World
{
public:
    explicit ChipmunkWorld(Vec gravity) : m_space(cpSpaceNew())
    {
        cpSpaceSetGravity(m_space.get(), vect(gravity));
        cpSpaceSetIterations(m_space.get(), 10);
        // Its default of 0.1 is meant for pixels.
        cpSpaceSetCollisionSlop(m_space.get(), 1e-3);
        cpCollisionHandler* handler = cpSpaceAddWildcardHandler(m_space.get(), sensor_type);
        handler->userData = this;
        handler->beginFunc = [](cpArbiter*, cpSpace*, cpDataPointer self) -> cpBool { return note(self, true); };
        handler->separateFunc = [](cpArbiter*, cpSpace*, cpDataPointer self) { note(self, false); };
    }

    Body add_body(const BodyDef& def) override
    {
        cpBody* body = make_body(def.motion);
        cpBodySetPosition(body, vect(def.position));
        cpBodySetAngle(body, def.angle);
        cpBodySetVelocity(body, vect(def.velocity));
        cpBodySetAngularVelocity(body, def.spin);
        m_bodies.emplace_back(cpSpaceAddBody(m_space.get(), body));
        return static_cast<Body>(m_bodies.size()) - 1;
    }

    // It multiplies the values of a pair.
    void add_shape(Body body, const Shape& shape, const Material& material) override
    {
        cpShape* made = std::visit(ToShape{find(body)}, shape);
        if (cpBodyGetType(find(body)) == CP_BODY_TYPE_DYNAMIC)
        {
            cpShapeSetDensity(made, material.density);
        }
        cpShapeSetElasticity(made, std::sqrt(material.restitution));
        cpShapeSetFriction(made, std::sqrt(material.friction));
        cpShapeSetSensor(made, material.sensor);
        cpShapeSetCollisionType(made, material.sensor ? sensor_type : 0);
        cpShapeSetFilter(made, cpShapeFilterNew(material.collides ? CP_NO_GROUP : 1, CP_ALL_CATEGORIES, CP_ALL_CATEGORIES));
        m_shapes.emplace_back(cpSpaceAddShape(m_space.get(), made));
    }

    void add_hinge(Body a, Body b, Vec anchor) override
    {
        cpConstraint* joint = cpPivotJointNew(find(a), find(b), vect(anchor));
        cpConstraintSetCollideBodies(joint, cpFalse);
        m_joints.emplace_back(cpSpaceAddConstraint(m_space.get(), joint));
    }

    void add_spring(Body a, Body b, double length, double stiffness, double damping) override
    {
        cpConstraint* spring = cpDampedSpringNew(find(a), find(b), cpvzero, cpvzero, length, stiffness, damping);
        m_joints.emplace_back(cpSpaceAddConstraint(m_space.get(), spring));
    }

    void set_motion(Body body, Vec velocity, double spin) override
    {
        cpBodySetVelocity(find(body), vect(velocity));
        cpBodySetAngularVelocity(find(body), spin);
    }

    // The distribution builds it with assertions: it aborts on a number that is none, so that a diverging world stands still.
    void step(double dt) override
    {
        m_crossings.clear();
        m_diverged = m_diverged || std::any_of(m_bodies.begin(), m_bodies.end(), far_away);
        if (!m_diverged)
        {
            cpSpaceStep(m_space.get(), dt);
        }
    }

    State state(Body body) const override
    {
        const cpBody* b = find(body);
        return {from(cpBodyGetPosition(b)), cpBodyGetAngle(b), from(cpBodyGetVelocity(b)), cpBodyGetAngularVelocity(b)};
    }

    std::vector<Crossing> crossings() const override { return m_crossings; }

private:
    struct Free
    {
        void operator()(cpSpace* space) const { cpSpaceFree(space); }
        void operator()(cpBody* body) const { cpBodyFree(body); }
        void operator()(cpShape* shape) const { cpShapeFree(shape); }
        void operator()(cpConstraint* joint) const { cpConstraintFree(joint); }
    };
    template <class T>
    using Owned = std::unique_ptr<T, Free>;

    static cpBool note(cpDataPointer self, bool enter)
    {
        static_cast<ChipmunkWorld*>(self)->m_crossings.push_back({enter, 0});
        return cpTrue;
    }
    static bool far_away(const Owned<cpBody>& body)
    {
        constexpr double far = 1e4;
        return !(cpvlength(cpBodyGetPosition(body.get())) < far && cpvlength(cpBodyGetVelocity(body.get())) < far);
    }
    cpBody* find(Body body) const
    {
        return body == ground ? cpSpaceGetStaticBody(m_space.get()) : m_bodies[static_cast<std::size_t>(body)].get();
    }

    // The space goes first: it refers to the rest.
    std::vector<Owned<cpBody>> m_bodies{};
    std::vector<Owned<cpShape>> m_shapes{};
    std::vector<Owned<cpConstraint>> m_joints{};
    std::vector<Crossing> m_crossings{};
    bool m_diverged = false;
    Owned<cpSpace> m_space;
};

/// Its first space prints a greeting on standard output, in the middle of a table or of JSON.
void greet_in_silence()
{
    std::fflush(stdout);
    const int saved = dup(STDOUT_FILENO);
    const int nowhere = open("/dev/null", O_WRONLY);
    if (saved >= 0 && nowhere >= 0)
    {
        dup2(nowhere, STDOUT_FILENO);
        cpSpaceFree(cpSpaceNew());
        std::fflush(stdout);
        dup2(saved, STDOUT_FILENO);
    }
    close(nowhere);
    close(saved);
}

} // namespace

Engine chipmunk_engine()
{
    greet_in_silence();
    return {std::string("Chipmunk ") + cpVersionString, [](Vec gravity) { return std::make_unique<ChipmunkWorld>(gravity); },
            true};
}

} // namespace truth
