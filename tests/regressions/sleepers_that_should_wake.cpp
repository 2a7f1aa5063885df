// Symptom: a body that hung from a moved or turned anchor, or that something static came to overlap, slept on; a body made asleep woke as soon as it got a
// shape.

#include "regressions/numbers.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

// --- hanging from something that moves ---------------------------------------------------------------------------------------------

using Make = std::pair<std::string, std::function<JointDef(BodyId anchor, BodyId body)>>;

std::vector<Make> joints()
{
    return {
        {"rod", [](BodyId a, BodyId b) -> JointDef { return DistanceDef{.body_a = a, .body_b = b}; }},
        {"rope", [](BodyId a, BodyId b) -> JointDef { return DistanceDef{.body_a = a, .body_b = b, .min_length = 0}; }},
        {"soft rod", [](BodyId a, BodyId b) -> JointDef { return DistanceDef{.body_a = a, .body_b = b, .hertz = 5}; }},
        {"spring",
         [](BodyId a, BodyId b) -> JointDef { return SpringDef{.body_a = a, .body_b = b, .stiffness = 200, .damping = 30}; }},
        {"hinge", [](BodyId a, BodyId b) -> JointDef { return RevoluteDef{.body_a = a, .body_b = b, .anchor_b = {0, 3}}; }},
        {"slider", [](BodyId a, BodyId b) -> JointDef
         { return PrismaticDef{.body_a = a, .body_b = b, .anchor_b = {0, 3}, .axis_a = {0, 1}, .enable_limit = true}; }},
        {"turned round", [](BodyId a, BodyId b) -> JointDef { return DistanceDef{.body_a = b, .body_b = a}; }},
    };
}

struct Move
{
    std::string name;
    BodyType type;
    std::function<void(Body)> make;
};

std::vector<Move> moves()
{
    return {
        {"velocity", BodyType::Kinematic, [](Body b) { b.set_velocity({0, 1}); }},
        {"slow velocity", BodyType::Kinematic, [](Body b) { b.set_velocity({0, 0.01f}); }},
        {"target", BodyType::Kinematic, [](Body b) { b.set_target_pose({0, 4}, 0); }},
        {"teleport", BodyType::Kinematic, [](Body b) { b.teleport({0, 4}, 0); }},
        {"teleport of a static body", BodyType::Static, [](Body b) { b.teleport({0, 4}, 0); }},
        {"turning", BodyType::Kinematic, [](Body b) { b.set_angular_velocity(1); }},
        {"another type", BodyType::Static, [](Body b) { b.set_type(BodyType::Dynamic); }},
        {"off", BodyType::Static, [](Body b) { b.set_enabled(false); }},
    };
}

} // namespace

TEST(Sleepers, WakeWhenWhatTheyHangFromMoves)
{
    for (const auto& [name, make] : joints())
    {
        for (const Move& move : moves())
        {
            SCOPED_TRACE(name + ", " + move.name);
            Scene scene;
            const BodyId anchor = add(scene, {.type = move.type, .position = {0, 3}}, Circle{.radius = 0.1f}).body;
            const BodyId body = add_dynamic(scene, {}, box(0.3f, 0.3f)).body;
            static_cast<void>(scene.create_joint(make(anchor, body)));
            for (int i = 0; i < 6000 && scene.body(body).is_awake(); ++i)
                scene.step(dt);
            ASSERT_FALSE(scene.body(body).is_awake());
            move.make(scene.body(anchor));
            EXPECT_TRUE(scene.body(body).is_awake());
        }
    }
}

TEST(Sleepers, StayAwakeWhileWhatTheyHangFromMoves)
{
    for (const auto& [name, make] : joints())
    {
        SCOPED_TRACE(name);
        Scene scene;
        const BodyId anchor = scene.create_body({.type = BodyType::Kinematic, .position = {0, 3}});
        const BodyId body = add_dynamic(scene, {}, box(0.3f, 0.3f)).body;
        static_cast<void>(scene.create_joint(make(anchor, body)));
        steps(scene, 60);
        scene.body(anchor).set_velocity({0, 0.01f});
        steps(scene, 600);
        EXPECT_TRUE(scene.body(body).is_awake());
        EXPECT_GT(scene.body(body).position().y, -0.5);
    }
}

TEST(Sleepers, WakeWhenTheirJointChanges)
{
    Scene scene;
    const BodyId body = add_dynamic(scene, {}, box(0.3f, 0.3f)).body;
    RevoluteDef def{.body_b = body, .anchor_b = {0, 1}, .enable_limit = true, .lower_angle = 0, .upper_angle = 1};
    const JointId hinge = scene.create_joint(def);
    steps(scene, 300);
    ASSERT_FALSE(scene.body(body).is_awake());
    def.lower_angle = 0.5f;
    scene.joint(hinge).set_def(def);
    EXPECT_TRUE(scene.body(body).is_awake());
    steps(scene, 120);
    EXPECT_NEAR(d(scene.joint(hinge).coordinate()), 0.5, 0.01);
}

// --- overlapped by something new ----------------------------------------------------------------------------------------------------

namespace {

// A box asleep on the floor at the origin, and a wall that does not meet it yet.
struct Asleep
{
    Scene scene{};
    BodyId body{};
    BodyId wall{};
    ShapeId wall_shape{};

    Asleep(Position wall_at, const ShapeDef& def = {}, bool enabled = true)
    {
        add_static(scene, box(5, 0.5f), {}, {0, -0.5});
        wall = scene.create_body({.position = wall_at, .enabled = enabled});
        wall_shape = scene.create_shape(wall, box(0.5f, 0.5f), def);
        body = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f)).body;
    }

    void fall_asleep()
    {
        steps(scene, 120);
        ASSERT_FALSE(scene.body(body).is_awake());
    }

    void expect_pushed()
    {
        steps(scene, 90);
        EXPECT_NEAR(scene.body(body).position().x, -0.4, 0.02);
    }
};

constexpr Position in_it{0.6, 0.6};
constexpr Position beside{3, 0.6};

} // namespace

TEST(Sleepers, WakeWhenSomethingIsMadeInThem)
{
    for (const bool round : {false, true})
    {
        Asleep s(beside);
        s.fall_asleep();
        const Geometry shape = round ? Geometry(Circle{.radius = 0.5f}) : Geometry(box(0.5f, 0.5f));
        add_static(s.scene, shape, {}, in_it);
        s.scene.step(dt);
        EXPECT_TRUE(s.scene.body(s.body).is_awake());
    }
    Asleep s(beside);
    s.fall_asleep();
    add_static(s.scene, box(0.5f, 0.5f), {}, in_it);
    s.expect_pushed();
}

TEST(Sleepers, WakeWhenSomethingIsSwitchedOnInThem)
{
    Asleep s(in_it, {}, false);
    s.fall_asleep();
    s.scene.body(s.wall).set_enabled(true);
    s.expect_pushed();
}

TEST(Sleepers, WakeWhenSomethingIsPutInThem)
{
    Asleep s(beside);
    s.fall_asleep();
    s.scene.body(s.wall).teleport(in_it, 0);
    s.expect_pushed();
}

TEST(Sleepers, WakeWhenAFilterLetsSomethingIn)
{
    Asleep s(in_it, {.filter = {.mask = 0}});
    s.fall_asleep();
    s.scene.shape(s.wall_shape).set_def({});
    s.expect_pushed();
}

TEST(Sleepers, WakeWhenATriggerBecomesSolid)
{
    Asleep s(in_it, {.trigger = true});
    s.fall_asleep();
    s.scene.shape(s.wall_shape).set_def({});
    s.expect_pushed();
}

TEST(Sleepers, WakeWhenAPairIsRestored)
{
    Asleep s(in_it);
    s.scene.ignore_pair(s.wall, s.body);
    s.fall_asleep();
    s.scene.restore_pair(s.wall, s.body);
    s.expect_pushed();
}

TEST(Sleepers, WakeWhenSomethingGrowsIntoThem)
{
    Asleep s({1.6, 0.6});
    s.fall_asleep();
    s.scene.shape(s.wall_shape).set_geometry(box(1.5f, 0.5f));
    s.expect_pushed();
}

TEST(Sleepers, WakeInAField)
{
    const ShapeDef lift{.trigger = true, .field = {.acceleration = {0, 20}}};
    for (int how = 0; how < 4; ++how)
    {
        SCOPED_TRACE(how);
        Asleep s(how == 1 ? beside : in_it, how == 0 || how == 2 ? ShapeDef{.trigger = true} : lift, how != 3);
        s.fall_asleep();
        if (how == 0) // made
            add_static(s.scene, box(0.5f, 0.5f), lift, in_it);
        if (how == 1) // moved over it
            s.scene.body(s.wall).teleport(in_it, 0);
        if (how == 2) // given to a trigger that is there
            s.scene.shape(s.wall_shape).set_def(lift);
        if (how == 3)
            s.scene.body(s.wall).set_enabled(true);
        steps(s.scene, 30);
        EXPECT_GT(s.scene.body(s.body).position().y, 0.7);
    }
}

TEST(Sleepers, SleepOnWhenAPlainTriggerIsMadeOverThem)
{
    Asleep s(beside);
    s.fall_asleep();
    add_static(s.scene, box(0.5f, 0.5f), {.trigger = true}, in_it);
    add_static(s.scene, box(0.5f, 0.5f), {}, {1, 0.5}); // flush with it
    steps(s.scene, 10);
    EXPECT_FALSE(s.scene.body(s.body).is_awake());
}

// --- made asleep --------------------------------------------------------------------------------------------------------------------

TEST(Sleepers, MadeAsleepStayAsleep)
{
    Scene scene;
    add_static(scene, box(5, 0.5f), {}, {0, -0.5});
    const BodyId lower = scene.create_body({.type = BodyType::Dynamic, .position = {0, 0.5}, .awake = false});
    scene.create_shape(lower, box(0.5f, 0.5f));
    const BodyId upper = scene.create_body({.type = BodyType::Dynamic, .position = {0, 1.5}, .awake = false});
    scene.create_shape(upper, box(0.25f, 0.5f, {-0.25f, 0}));
    scene.create_shape(upper, box(0.25f, 0.5f, {0.25f, 0}));
    const BodyId floating = scene.create_body({.type = BodyType::Dynamic, .position = {3, 3}, .awake = false});
    scene.create_shape(floating, Circle{.radius = 0.3f});
    steps(scene, 60);
    for (const BodyId id : {lower, upper, floating})
        EXPECT_FALSE(scene.body(id).is_awake());
    scene.body(lower).apply_impulse({5, 0});
    steps(scene, 2);
    EXPECT_TRUE(scene.body(lower).is_awake());
}
