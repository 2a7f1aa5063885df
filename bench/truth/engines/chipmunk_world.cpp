#include "truth/engines/engines.h"

#include <chipmunk/chipmunk.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <limits>
#include <unordered_map>

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

    cpShape* operator()(const Disc& disc) const { return cpCircleShapeNew(body, disc.radius, vect(disc.center)); }
    cpShape* operator()(const Segment& segment) const { return cpSegmentShapeNew(body, vect(segment.a), vect(segment.b), 0); }
    cpShape* operator()(const Capsule& capsule) const
    {
        return cpSegmentShapeNew(body, vect(capsule.a), vect(capsule.b), capsule.radius);
    }
    cpShape* operator()(const Polygon& polygon) const
    {
        std::vector<cpVect> vertices;
        std::transform(polygon.vertices.begin(), polygon.vertices.end(), std::back_inserter(vertices), vect);
        return cpPolyShapeNewRaw(body, static_cast<int>(vertices.size()), vertices.data(), polygon.radius);
    }
};

constexpr cpCollisionType sensor_type = 1;

class ChipmunkWorld final : public World
{
public:
    explicit ChipmunkWorld(const WorldDef& def) : m_space(cpSpaceNew())
    {
        cpSpaceSetGravity(m_space.get(), vect(def.gravity));
        // Off by default; half a second is what the others wait.
        cpSpaceSetSleepTimeThreshold(m_space.get(), def.sleeping ? 0.5 : std::numeric_limits<double>::infinity());
        cpSpaceSetIterations(m_space.get(), 10);
        // Its default of 0.1 is meant for pixels.
        cpSpaceSetCollisionSlop(m_space.get(), 1e-3);
        cpCollisionHandler* handler = cpSpaceAddWildcardHandler(m_space.get(), sensor_type);
        handler->userData = this;
        handler->beginFunc = [](cpArbiter*, cpSpace*, cpDataPointer self) -> cpBool { return note(self, true); };
        handler->separateFunc = [](cpArbiter*, cpSpace*, cpDataPointer self) { note(self, false); };
    }

    // It has no damping of a single body, and a body cannot be kept from sleeping.
    Body add_body(const BodyDef& def) override
    {
        cpBody* body = make_body(def.motion);
        cpBodySetPosition(body, vect(def.position));
        cpBodySetAngle(body, def.angle);
        cpBodySetVelocity(body, vect(def.velocity));
        cpBodySetAngularVelocity(body, def.spin);
        m_bodies.push_back({Owned<cpBody>(cpSpaceAddBody(m_space.get(), body)), {}});
        if (!def.awake && cpSpaceGetSleepTimeThreshold(m_space.get()) < std::numeric_limits<double>::infinity())
        {
            m_to_sleep.push_back(body);
        }
        return static_cast<Body>(m_bodies.size()) - 1;
    }

    void add_shape(Body body, const Shape& shape, const Material& material) override
    {
        own(body, std::visit(ToShape{find(body)}, shape), material);
    }

    void add_ring(Body body, const std::vector<Vec>& corners, const Material& material) override
    {
        const std::size_t count = corners.size();
        for (std::size_t i = 0; i < count; ++i)
        {
            const auto corner = [&](std::size_t ahead) { return vect(corners[(i + ahead) % count]); };
            cpShape* side = cpSegmentShapeNew(find(body), corner(0), corner(1), 0);
            cpSegmentShapeSetNeighbors(side, corner(count - 1), corner(2));
            own(body, side, material);
        }
    }

    // Everything beside the pivot of a hinge is a constraint of its own. A motor and a spring count a's angle less b's.
    void add_hinge(const Hinge& hinge) override
    {
        cpBody* a = find(hinge.a);
        cpBody* b = find(hinge.b);
        if (cpBodyGetType(a) != CP_BODY_TYPE_DYNAMIC && cpBodyGetType(b) != CP_BODY_TYPE_DYNAMIC)
        {
            return; // it aborts on a joint that can move nothing
        }
        cpConstraintSetCollideBodies(own(cpPivotJointNew(a, b, vect(hinge.anchor))), cpFalse);
        if (hinge.limited)
        {
            own(cpRotaryLimitJointNew(a, b, hinge.reference + hinge.lower, hinge.reference + hinge.upper));
        }
        if (hinge.driven)
        {
            cpConstraintSetMaxForce(own(cpSimpleMotorNew(a, b, -hinge.motor_speed)), hinge.motor_torque);
        }
        if (hinge.hertz > 0)
        {
            const double inertia = 1 / (1 / cpBodyGetMoment(a) + 1 / cpBodyGetMoment(b));
            const double w = 2 * pi * hinge.hertz;
            own(cpDampedRotarySpringNew(a, b, -hinge.reference, inertia * w * w, 2 * inertia * hinge.damping_ratio * w));
        }
    }

    // A groove that a's anchor runs along, and a gear that holds the angle.
    void add_slider(const Slider& slider) override
    {
        cpBody* a = find(slider.a);
        cpBody* b = find(slider.b);
        const double unit = 1 / length(slider.axis);
        const double reach = 1000; // where it has no limit
        const auto end = [&](double at) { return cpBodyWorldToLocal(a, vect(slider.anchor + at * unit * slider.axis)); };
        cpConstraint* groove =
            cpGrooveJointNew(a, b, end(slider.limited ? slider.lower : -reach), end(slider.limited ? slider.upper : reach),
                             cpBodyWorldToLocal(b, vect(slider.anchor)));
        cpConstraintSetCollideBodies(own(groove), cpFalse);
        own(cpGearJointNew(a, b, cpBodyGetAngle(b) - cpBodyGetAngle(a), 1));
    }

    // It takes the distance that the bodies have.
    void add_rod(Body a, Body b, double) override
    {
        cpConstraintSetCollideBodies(own(cpPinJointNew(find(a), find(b), cpvzero, cpvzero)), cpFalse);
    }

    void add_spring(Body a, Body b, double length, double stiffness, double damping) override
    {
        own(cpDampedSpringNew(find(a), find(b), cpvzero, cpvzero, length, stiffness, damping));
    }

    void remove_body(Body body) override
    {
        Part& part = m_bodies[static_cast<std::size_t>(body)];
        std::vector<cpConstraint*> joints;
        const auto note_joint = [](cpBody*, cpConstraint* joint, void* list)
        { static_cast<std::vector<cpConstraint*>*>(list)->push_back(joint); };
        cpBodyEachConstraint(part.body.get(), note_joint, &joints);
        for (cpConstraint* joint : joints)
        {
            cpSpaceRemoveConstraint(m_space.get(), joint);
            m_joints.erase(joint);
        }
        for (const Owned<cpShape>& shape : part.shapes)
        {
            cpSpaceRemoveShape(m_space.get(), shape.get());
        }
        cpSpaceRemoveBody(m_space.get(), part.body.get());
        part.shapes.clear();
        part.body.reset();
    }

    // Its own number is not public. Every pair of two dynamic bodies is met twice.
    int contacts() const override
    {
        int sides = 0;
        const auto count = [](cpBody* body, cpArbiter* pair, void* sum)
        {
            cpBody* a = nullptr;
            cpBody* b = nullptr;
            cpArbiterGetBodies(pair, &a, &b);
            *static_cast<int*>(sum) += cpBodyGetType(a == body ? b : a) == CP_BODY_TYPE_DYNAMIC ? 1 : 2;
        };
        for (const Part& part : m_bodies)
        {
            if (part.body && cpBodyGetType(part.body.get()) == CP_BODY_TYPE_DYNAMIC)
            {
                cpBodyEachArbiter(part.body.get(), count, &sides);
            }
        }
        return sides / 2;
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
        put_to_sleep();
        m_diverged = m_diverged || std::any_of(m_bodies.begin(), m_bodies.end(), far_away);
        if (!m_diverged)
        {
            cpSpaceStep(m_space.get(), dt);
        }
    }

    State state(Body body) const override
    {
        const cpBody* b = find(body);
        return {from(cpBodyGetPosition(b)), cpBodyGetAngle(b), from(cpBodyGetVelocity(b)), cpBodyGetAngularVelocity(b),
                !cpBodyIsSleeping(b)};
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

    struct Part
    {
        Owned<cpBody> body{};
        std::vector<Owned<cpShape>> shapes{};
    };

    // It multiplies the values of a pair.
    void own(Body body, cpShape* made, const Material& material)
    {
        if (cpBodyGetType(find(body)) == CP_BODY_TYPE_DYNAMIC)
        {
            cpShapeSetDensity(made, material.density);
        }
        cpShapeSetElasticity(made, std::sqrt(material.restitution));
        cpShapeSetFriction(made, std::sqrt(material.friction));
        cpShapeSetSensor(made, material.sensor);
        cpShapeSetCollisionType(made, material.sensor ? sensor_type : 0);
        const cpGroup group = static_cast<cpGroup>(material.filter.group); // CP_NO_GROUP is 0
        cpShapeSetFilter(made, cpShapeFilterNew(group, material.filter.category, material.filter.mask));
        m_bodies[static_cast<std::size_t>(body)].shapes.emplace_back(cpSpaceAddShape(m_space.get(), made));
    }
    cpConstraint* own(cpConstraint* joint)
    {
        m_joints.emplace(joint, cpSpaceAddConstraint(m_space.get(), joint));
        return joint;
    }
    // Once it has its shapes.
    void put_to_sleep()
    {
        for (cpBody* body : m_to_sleep)
        {
            cpBodySleep(body);
        }
        m_to_sleep.clear();
    }
    static cpBool note(cpDataPointer self, bool enter)
    {
        static_cast<ChipmunkWorld*>(self)->m_crossings.push_back({enter, 0});
        return cpTrue;
    }
    static bool far_away(const Part& part)
    {
        constexpr double far = 1e4;
        const cpBody* body = part.body.get();
        return body && !(cpvlength(cpBodyGetPosition(body)) < far && cpvlength(cpBodyGetVelocity(body)) < far);
    }
    cpBody* find(Body body) const
    {
        return body == ground ? cpSpaceGetStaticBody(m_space.get()) : m_bodies[static_cast<std::size_t>(body)].body.get();
    }

    // The space goes first: it refers to the rest.
    std::vector<Part> m_bodies{};
    std::unordered_map<cpConstraint*, Owned<cpConstraint>> m_joints{};
    std::vector<cpBody*> m_to_sleep{};
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
    return {.name = std::string("Chipmunk ") + cpVersionString,
            .make_world = [](const WorldDef& def) { return std::make_unique<ChipmunkWorld>(def); },
            .peer = true,
            .key = "chipmunk"};
}

} // namespace truth
