// The public API must survive any sequence of calls with any values: it does what was asked or refuses with an Error, keeps every pose
// finite, and what it says exists is there. Bytes choose the calls; values are small, huge or not finite; ids may be stale; callbacks
// destroy what they are told about. Every step is judged (step_judge.h); in one session of two nothing does work and numbers are those of every day, so that
// energy and momentum can be.

#include "carom/carom.h"
#include "fuzz/step_judge.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <variant>
#include <vector>

using namespace carom;
using carom::test::require;
using carom::test::StepJudge;

namespace {

/// The bytes as a stream of choices; zeros after the end.
class Choices
{
public:
    Choices(const std::uint8_t* data, std::size_t size) : m_data(data), m_end(data + size) {}

    [[nodiscard]] bool left() const { return m_data < m_end; }
    std::uint8_t byte() { return left() ? *m_data++ : 0; }
    int below(int n) { return byte() % n; }
    bool flag() { return (byte() & 1) != 0; }
    /// Mostly within ±4 in steps of 1/32; the rest is what goes wrong elsewhere.
    float number()
    {
        constexpr float infinity = std::numeric_limits<float>::infinity();
        constexpr std::array<float, 6> odd = {0, std::numeric_limits<float>::quiet_NaN(), infinity, -infinity, 1e-4f, 1e4f};
        const int b = byte();
        return b == 255 ? odd[byte() % odd.size()] : static_cast<float>(b - 127) / 32;
    }
    /// Mostly fit for a size, a mass or a stiffness.
    float amount()
    {
        const float x = number();
        return x < 0 && byte() < 250 ? -x : x;
    }
    Vec2 vec()
    {
        const float x = number();
        return {x, number()};
    }
    Position position()
    {
        const Vec2 v = vec();
        return v;
    }

private:
    const std::uint8_t* m_data;
    const std::uint8_t* m_end;
};

/// Whatever was made; ids stay here when their things are gone.
struct Session
{
    explicit Session(const SceneDef& def) : scene(def) {}

    Scene scene;
    std::vector<BodyId> bodies{BodyId{}};
    std::vector<ShapeId> shapes{ShapeId{}};
    std::vector<JointId> joints{JointId{}};
    StepJudge judge;
    int made_in_callbacks = 0;
    bool is_passive = false; ///< nothing is made that does work, nor what stops or turns without giving way

    template <class Id>
    static Id pick(Choices& c, const std::vector<Id>& ids)
    {
        return ids[c.byte() % ids.size()];
    }
    BodyId body(Choices& c) { return pick(c, bodies); }
    ShapeId shape(Choices& c) { return pick(c, shapes); }
    JointId joint(Choices& c) { return pick(c, joints); }
};

SceneDef scene_def(Choices& c)
{
    SceneDef def;
    if (c.flag())
        return def;
    def.gravity = c.vec();
    def.length_scale = c.amount();
    def.substeps = c.below(9);
    def.friction_rule = static_cast<MixRule>(c.below(6));
    def.restitution_rule = static_cast<MixRule>(c.below(6));
    def.contact_hertz = 10 * c.amount();
    def.contact_push_speed = c.amount();
    def.sleeping = c.flag();
    def.continuous = c.flag();
    def.record_substeps = c.flag();
    return def;
}

Chain chain(Choices& c)
{
    Chain chain{.start = c.vec()};
    for (int i = c.below(6); i > 0; --i)
    {
        const Vec2 end = c.vec();
        chain.pieces.push_back({.end = end, .sweep = c.flag() ? 0 : c.number()});
    }
    chain.closed = c.flag();
    chain.half_thickness = c.flag() ? 0 : c.amount() / 8;
    chain.sides = static_cast<Sides>(c.below(3));
    return chain;
}

// Many corners, evenly around.
Polygon wheel(Choices& c)
{
    Polygon polygon;
    const int corners = 3 + 4 * c.below(16);
    const float radius = 0.1f + std::fabs(c.amount()) / 4;
    for (int i = 0; i < corners; ++i)
    {
        const float angle = 2 * pi * static_cast<float>(i) / static_cast<float>(corners);
        polygon.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return polygon;
}

Polygon polygon(Choices& c)
{
    Polygon polygon;
    for (int i = c.below(8); i > 0; --i)
        polygon.vertices.push_back(c.vec());
    polygon.radius = c.flag() ? 0 : c.amount() / 8;
    return polygon;
}

// Invariants of passive sessions, seen from both sides.
Geometry two_sided(Geometry of)
{
    std::visit(
        [](auto& g)
        {
            if constexpr (requires { g.sides; })
                g.sides = Sides::Both;
        },
        of);
    return of;
}

Geometry geometry(Choices& c)
{
    switch (c.below(9))
    {
    case 8: return wheel(c);
    case 0: return Circle{.center = c.flag() ? Vec2{} : c.vec(), .radius = c.amount() / 4};
    case 1: return Circle{.radius = 0.25f};
    case 2:
    {
        const float width = c.amount();
        return box(0.1f + std::fabs(width), 0.2f);
    }
    case 3: return polygon(c);
    case 4: return Capsule{.a = c.vec(), .b = c.vec(), .radius_a = c.amount() / 4, .radius_b = c.amount() / 4};
    case 5: return Segment{.a = c.vec(), .b = c.vec(), .half_thickness = c.amount() / 8, .sides = static_cast<Sides>(c.below(3))};
    case 6:
        return Arc{.center = c.vec(),
                   .radius = c.amount(),
                   .start_angle = c.number(),
                   .sweep = c.number(),
                   .half_thickness = c.amount() / 8,
                   .sides = static_cast<Sides>(c.below(3))};
    default: return c.flag() ? Geometry{chain(c)} : Geometry{HalfSpace{c.vec(), c.number()}};
    }
}

Geometry geometry(const Session& s, Choices& c)
{
    const Geometry made = geometry(c);
    return s.is_passive ? two_sided(made) : made;
}

ShapeDef shape_def(const Session& s, Choices& c)
{
    ShapeDef def;
    if (c.flag())
        return def;
    def.density = c.amount();
    def.friction = c.amount();
    def.restitution = c.amount() / 4;
    def.rolling_resistance = c.flag() ? 0 : c.amount();
    def.filter.group = c.below(3) - 1;
    def.trigger = c.below(4) == 0;
    if (s.is_passive)
        return def;
    def.one_way = c.flag() ? Vec2{} : c.vec();
    def.surface_speed = c.flag() ? 0 : c.number();
    def.kick = {.speed = c.flag() ? 0 : c.amount(), .threshold = c.amount(), .cooldown = c.amount()};
    if (def.trigger || c.below(8) == 0) // elsewhere it is refused
        def.field = {.force = c.flag() ? Vec2{} : c.vec(), .acceleration = {}, .drag = c.flag() ? 0 : c.amount()};
    return def;
}

void make_body(Session& s, Choices& c)
{
    BodyDef def{.type = s.is_passive ? (c.flag() ? BodyType::Dynamic : BodyType::Static) : static_cast<BodyType>(c.below(3)),
                .position = c.position(),
                .angle = c.number(),
                .velocity = c.vec()};
    if (c.flag())
        def.velocity *= s.is_passive ? 5.0f : 100.0f;
    def.angular_velocity = c.flag() ? 0 : 10 * c.number();
    if (!s.is_passive)
        def.locks = {.linear_x = c.below(8) == 0, .linear_y = c.below(8) == 0, .angular = c.below(8) == 0};
    def.enabled = c.below(8) != 0;
    def.awake = c.below(8) != 0;
    s.bodies.push_back(s.scene.create_body(def));
    s.shapes.push_back(s.scene.create_shape(s.bodies.back(), geometry(s, c), shape_def(s, c)));
}

void make_shape(Session& s, Choices& c)
{
    const BodyId body = s.body(c);
    const Geometry made = geometry(s, c);
    s.shapes.push_back(s.scene.create_shape(body, made, shape_def(s, c)));
}

template <class Def>
Def ends(Session& s, Choices& c)
{
    Def def;
    def.body_a = s.body(c);
    def.body_b = s.body(c);
    def.anchor_a = c.vec();
    def.anchor_b = c.vec();
    def.collide_connected = c.flag();
    return def;
}

template <class Def>
void limits_and_motor(Def& def, const Session& s, Choices& c)
{
    def.reference_angle = c.flag() ? 0 : c.number();
    if (s.is_passive)
        return;
    def.enable_limit = c.flag();
    def.limit_restitution = c.amount() / 4;
    def.enable_motor = c.flag();
    def.motor_speed = c.number();
    def.spring_hertz = c.flag() ? 0 : 10 * c.amount();
    def.spring_damping_ratio = c.amount();
}

JointDef joint_def(Session& s, Choices& c)
{
    switch (c.below(5))
    {
    case 0:
    {
        auto def = ends<SpringDef>(s, c);
        def.stiffness = 100 * c.amount();
        def.damping = c.amount();
        def.length = c.number();
        return def;
    }
    case 1:
    {
        auto def = ends<DistanceDef>(s, c);
        def.min_length = c.number();
        def.max_length = c.number();
        def.hertz = s.is_passive || c.flag() ? 0 : 10 * c.amount();
        return def;
    }
    case 2:
    {
        auto def = ends<RevoluteDef>(s, c);
        limits_and_motor(def, s, c);
        def.lower_angle = c.number();
        def.upper_angle = c.number();
        def.max_motor_torque = 10 * c.amount();
        return def;
    }
    case 3:
    {
        auto def = ends<WeldDef>(s, c);
        def.reference_angle = c.flag() ? 0 : c.number();
        return def;
    }
    default:
    {
        auto def = ends<PrismaticDef>(s, c);
        limits_and_motor(def, s, c);
        def.axis_a = c.vec();
        def.lower_translation = c.number();
        def.upper_translation = c.number();
        def.max_motor_force = 10 * c.amount();
        return def;
    }
    }
}

void change_body(Session& s, Choices& c)
{
    Body body = s.scene.body(s.body(c));
    switch (c.below(16))
    {
    case 0: return body.set_type(s.is_passive ? BodyType::Dynamic : static_cast<BodyType>(c.below(3)));
    case 1:
    {
        const Position p = c.position();
        return body.teleport(p, c.number());
    }
    case 2:
    {
        const Position p = c.position();
        return body.set_target_pose(p, c.number());
    }
    case 3: return body.set_velocity((s.is_passive ? 10.0f : c.below(8) == 0 ? 1e5f : 250.0f) * c.vec());
    case 4: return body.set_angular_velocity(20 * c.number());
    case 5:
    {
        const Vec2 force = c.vec();
        return body.apply_force(100 * force, c.position());
    }
    case 6: return body.apply_torque(100 * c.number());
    case 7:
    {
        const Vec2 impulse = c.vec();
        return body.apply_impulse(impulse, c.position());
    }
    case 8: return body.apply_angular_impulse(c.number());
    case 9:
        if (s.is_passive)
            return;
        return body.set_locks({.linear_x = c.flag(), .linear_y = c.flag(), .angular = c.flag()});
    case 10:
    {
        if (s.is_passive)
            return;
        const float mass = c.amount();
        const Vec2 center = c.vec();
        return body.set_mass({mass, center, c.amount()});
    }
    case 11: return body.reset_mass();
    case 12: return body.set_enabled(c.flag());
    case 13: return body.set_awake(c.flag());
    case 14: return body.set_gravity_scale(c.number());
    default: body.set_linear_damping(c.amount()); body.set_angular_damping(c.amount());
    }
}

void change_shape(Session& s, Choices& c)
{
    Shape shape = s.scene.shape(s.shape(c));
    if (c.flag())
        shape.set_def(shape_def(s, c));
    else
        shape.set_geometry(geometry(s, c));
}

void destroy(Session& s, Choices& c)
{
    switch (c.below(3))
    {
    case 0: return s.scene.destroy(s.body(c));
    case 1: return s.scene.destroy(s.shape(c));
    default: return s.scene.destroy(s.joint(c));
    }
}

// The action of a callback on the two that it is told about; they may be gone already.
void meddle(Session& s, Scene& scene, int deed, BodyId a, BodyId b, ShapeId shape)
{
    s.judge.meddle();
    if (deed == 0 && scene.is_valid(a))
        scene.destroy(a);
    if (deed == 1 && scene.is_valid(b))
        scene.destroy(b);
    if (deed == 2 && scene.is_valid(shape))
        scene.destroy(shape);
    if (deed == 3 && ++s.made_in_callbacks < 50)
    {
        s.bodies.push_back(scene.create_body({.type = BodyType::Dynamic}));
        s.shapes.push_back(scene.create_shape(s.bodies.back(), Circle{.radius = 0.1f}));
    }
    if (deed == 4 && scene.is_valid(a))
        scene.body(a).set_velocity({300, 20});
}

void set_callbacks(Session& s, Choices& c)
{
    const ShapeId shape = s.shape(c);
    const int deed = c.below(6);
    const auto contact = [&s, deed](Scene& scene, const auto& e) { meddle(s, scene, deed, e.body_a, e.body_b, e.shape_b); };
    const auto trigger = [&s, deed](Scene& scene, const TriggerEvent& e)
    { meddle(s, scene, deed, e.trigger_body, e.visitor_body, e.visitor); };
    ShapeCallbacks callbacks;
    switch (c.below(6))
    {
    case 0: callbacks.on_contact_begin = contact; break;
    case 1: callbacks.on_impact = contact; break;
    case 2: callbacks.on_contact_end = contact; break;
    case 3: callbacks.on_trigger_enter = trigger; break;
    case 4: callbacks.on_trigger_inside = trigger; break;
    default: callbacks.on_trigger_exit = trigger;
    }
    s.scene.set_callbacks(shape, std::move(callbacks));
}

void ask(Session& s, Choices& c)
{
    Scene& scene = s.scene;
    switch (c.below(9))
    {
    case 0:
    {
        const Position from = c.position();
        static_cast<void>(scene.raycast_all(from, 4 * c.vec()));
        return;
    }
    case 1: static_cast<void>(scene.overlap_point(c.position())); return;
    case 2:
    {
        const Position lower = c.position();
        static_cast<void>(scene.overlap_box({lower, c.position()}));
        return;
    }
    case 3: static_cast<void>(scene.overlap_shape(geometry(c), {c.position(), Rotation::from_angle(1)})); return;
    case 4:
    {
        const Position from = c.position();
        static_cast<void>(scene.closest_point(from, c.amount()));
        return;
    }
    case 5: static_cast<void>(scene.inside(s.shape(c))); return;
    case 6:
    {
        const CastWay way{.start = {c.position(), Rotation::from_angle(1)}, .translation = 4 * c.vec(), .turn = c.amount()};
        static_cast<void>(scene.shapecast_all(geometry(c), way, {.without = s.body(c)}));
        return;
    }
    case 7:
    {
        DebugDraw draw;
        scene.debug_draw(draw, {.boxes = true, .contacts = true, .normals = true, .impulses = true, .islands = true});
        return;
    }
    default: static_cast<void>(scene.body(s.body(c)).contacts()); static_cast<void>(scene.joint(s.joint(c)).force());
    }
}

// A force law in place of what a body had: a pull home, or what is no force.
Load pull_home(void*, const BodyMotion& motion)
{
    return {{-static_cast<float>(motion.pose.position.x), -static_cast<float>(motion.pose.position.y)}, -motion.angular_velocity};
}

Load no_force(void*, const BodyMotion&) { return {{std::numeric_limits<float>::quiet_NaN(), 0}, 0}; }

void set_force_law(Session& s, Choices& c)
{
    const BodyId body = s.body(c);
    const int kind = s.is_passive ? 0 : c.below(4);
    const ForceLaw law{
        .function = kind == 3 ? no_force : pull_home, .user = nullptr, .greatest_force = c.flag() ? 0 : c.amount()};
    s.scene.set_force_law(body, kind == 0 ? ForceLaw{} : law);
}

void take_step(Session& s, float h)
{
    s.judge.begin(s.scene);
    s.scene.step(h);
    s.judge.end(s.scene, h);
}

void take_update(Session& s, Choices& c)
{
    s.judge.begin(s.scene);
    const double before = s.scene.time();
    const float frame = c.number() / 16;
    if (c.flag())
        s.scene.update(frame);
    else
        s.scene.update(frame, [&](Scene&) {});
    s.judge.end(s.scene, static_cast<float>(s.scene.time() - before));
}

void step(Session& s, Choices& c)
{
    const int b = c.below(32);
    if (b == 0)
        take_step(s, c.number() / 16); // to a quarter of a second, or what is refused
    else if (b == 1)
        take_update(s, c);
    else
        for (int i = b % 4; i >= 0; --i)
            take_step(s, 1.0f / 60);
}

void change(Session& s, Choices& c, int what)
{
    s.judge.disturb();
    switch (what)
    {
    case 0:
    case 1:
    case 2:
    case 3: return make_body(s, c);
    case 4: return make_shape(s, c);
    case 5:
    case 6: s.joints.push_back(s.scene.create_joint(joint_def(s, c))); return;
    case 7: return destroy(s, c);
    case 8: return s.scene.joint(s.joint(c)).set_def(joint_def(s, c));
    case 9: return change_shape(s, c);
    case 10:
    case 11: return change_body(s, c);
    case 12: return set_callbacks(s, c);
    case 13: return set_force_law(s, c);
    case 14:
    {
        const BodyId a = s.body(c);
        return c.flag() ? s.scene.ignore_pair(a, s.body(c)) : s.scene.restore_pair(a, s.body(c));
    }
    default: return s.scene.set_gravity(c.vec());
    }
}

void call(Session& s, Choices& c)
{
    const int what = c.below(22);
    if (what < 16)
        change(s, c, what);
    else if (what == 16)
        ask(s, c);
    else
        step(s, c);
}

void play(Choices& c)
{
    Session session(scene_def(c));
    session.is_passive = c.flag();
    if (!session.is_passive)
        session.judge.allow_work();
    for (int i = 0; c.left() && i < 300; ++i)
    {
        try
        {
            call(session, c);
        }
        catch (const Error& error)
        {
            require(error.what()[0] != 0, "a refusal without a sentence");
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Choices choices(data, size);
    try
    {
        play(choices);
    }
    catch (const Error&)
    {
        // the scene itself was refused
    }
    return 0;
}
