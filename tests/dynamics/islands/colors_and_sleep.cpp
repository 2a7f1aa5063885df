// The constraint graph and sleeping.

#include "support/test_scene.h"

#include <cmath>
#include <map>
#include <set>

using namespace carom;
using namespace carom::test;

namespace {

void build_pyramid(Scene& scene, int rows, std::vector<BodyId>& boxes)
{
    add_static(scene, box(50, 0.5f, {0, -0.5f}));
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < rows - row; ++i)
            boxes.push_back(add_dynamic(scene, {i - 0.5 * (rows - row - 1), 0.5 + row}, box(0.48f, 0.5f)).body);
}

int awake(Scene& scene, const std::vector<BodyId>& bodies)
{
    int count = 0;
    for (const BodyId id : bodies)
        count += scene.body(id).is_awake();
    return count;
}

void expect_proper_coloring(Scene& scene)
{
    std::map<int, std::set<BodyId>> seen;
    for (const ContactInfo& c : scene.contacts())
    {
        if (c.color < 0)
            continue;
        for (const ShapeId shape : {c.shape_a, c.shape_b})
        {
            const BodyId body = scene.shape(shape).body();
            if (scene.body(body).type() != BodyType::Dynamic)
                continue;
            ASSERT_TRUE(seen[c.color].insert(body).second) << "color " << c.color << " has body " << body.slot << " twice";
        }
    }
}

} // namespace

TEST(DynamicsColors, NoTwoContactsOfAColorShareAMovingBody)
{
    Scene scene(sleepless());
    Random random(3);
    add_static(scene, Chain{.start = {-4, 0}, .pieces = {{.end = {4, 0}}, {.end = {4, 9}}, {.end = {-4, 9}}}, .closed = true});
    for (int i = 0; i < 150; ++i)
        add_dynamic(scene, {random.range(-3.5, 3.5), random.range(0.5, 8)},
                    i % 3 == 0 ? Geometry{Circle{.radius = 0.25f}} : Geometry{box(0.25f, 0.2f)});
    for (int i = 0; i < 180; ++i)
    {
        scene.step(1.0f / 60);
        expect_proper_coloring(scene);
        if (HasFatalFailure())
            return;
    }
}

TEST(DynamicsColors, APyramidOf20RowsNeedsFew)
{
    Scene scene(sleepless());
    std::vector<BodyId> boxes;
    build_pyramid(scene, 20, boxes);
    steps(scene, 30);
    expect_proper_coloring(scene);
    EXPECT_GT(scene.report().colors, 1);
    EXPECT_LT(scene.report().colors, 10);
    EXPECT_FALSE(scene.report().has(StepFlag::ColorsExhausted));
    int colored = 0;
    for (const ContactInfo& c : scene.contacts())
        colored += c.color >= 0;
    EXPECT_GT(colored, 300);
}

TEST(DynamicsStack, APyramidStandsAndSleeps)
{
    Scene scene;
    std::vector<BodyId> boxes;
    build_pyramid(scene, 12, boxes);
    steps(scene, 600);
    EXPECT_EQ(awake(scene, boxes), 0);
    EXPECT_NEAR(scene.body(boxes.back()).position().y, 11.5, 0.15);
    EXPECT_NEAR(scene.body(boxes.back()).position().x, 0, 0.05);
}

TEST(DynamicsSleep, AStackFallsAsleepAndWakesOnTouch)
{
    Scene scene;
    add_static(scene, HalfSpace{});
    std::vector<BodyId> stack;
    for (int i = 0; i < 5; ++i)
        stack.push_back(add_dynamic(scene, {0, 0.5 + i}, box(0.5f, 0.5f)).body);
    const BodyId alone = add_dynamic(scene, {20, 0.5}, box(0.5f, 0.5f)).body;
    steps(scene, 300);
    ASSERT_EQ(awake(scene, stack), 0);
    ASSERT_FALSE(scene.body(alone).is_awake());
    const Position before = scene.body(stack[4]).position();
    steps(scene, 60);
    EXPECT_EQ(scene.body(stack[4]).position(), before) << "asleep means still, bit for bit";
    EXPECT_EQ(scene.report().awake_bodies, 0);
    add_dynamic(scene, {0, 7}, Circle{.radius = 0.3f}, {}, {0, -3});
    int most = 0;
    for (int i = 0; i < 60; ++i)
    {
        scene.step(1.0f / 60);
        most = std::max(most, awake(scene, stack));
    }
    EXPECT_EQ(most, 5) << "the whole island wakes";
    EXPECT_FALSE(scene.body(alone).is_awake()) << "and nothing else";
}

TEST(DynamicsSleep, EachBodyAtItsOwnSpeed)
{
    Scene scene({.gravity = {}});
    const auto drifting = [&](double y, float sleep_speed)
    {
        const BodyId body = scene.create_body(
            {.type = BodyType::Dynamic, .position = {0, y}, .velocity = {0.08f, 0}, .sleep_speed = sleep_speed});
        scene.create_shape(body, Circle{.radius = 0.5f});
        return body;
    };
    const BodyId usual = drifting(0, 0);
    const BodyId sleepy = drifting(3, 2);
    EXPECT_EQ(scene.body(usual).sleep_speed(), 0.05f) << "the scene's";
    EXPECT_EQ(scene.body(sleepy).sleep_speed(), 2);
    steps(scene, 60);
    EXPECT_TRUE(scene.body(usual).is_awake());
    EXPECT_FALSE(scene.body(sleepy).is_awake());
    scene.body(usual).set_sleep_speed(2);
    scene.body(sleepy).set_sleep_speed(0);
    scene.body(sleepy).set_velocity({0.08f, 0});
    steps(scene, 60);
    EXPECT_FALSE(scene.body(usual).is_awake());
    EXPECT_TRUE(scene.body(sleepy).is_awake());
    Scene large({.length_scale = 4});
    EXPECT_EQ(large.body(large.create_body({})).sleep_speed(), 0.2f);
}

TEST(DynamicsSleep, WakesWhenItsSupportGoes)
{
    struct How
    {
        const char* name;
        void (*go)(Scene&, const Thing&);
    };
    const How ways[] = {
        {"destroy body", [](Scene& s, const Thing& t) { s.destroy(t.body); }},
        {"destroy shape", [](Scene& s, const Thing& t) { s.destroy(t.shape); }},
        {"disable", [](Scene& s, const Thing& t) { s.body(t.body).set_enabled(false); }},
        {"teleport", [](Scene& s, const Thing& t) { s.body(t.body).teleport({0, -40}, 0); }},
        {"filter", [](Scene& s, const Thing& t) { s.shape(t.shape).set_def({.filter = {.category = 0, .mask = 0}}); }},
        {"trigger", [](Scene& s, const Thing& t) { s.shape(t.shape).set_def({.trigger = true}); }},
        {"geometry", [](Scene& s, const Thing& t) { s.shape(t.shape).set_geometry(box(0.1f, 0.1f, {30, 0})); }},
        {"set_type", [](Scene& s, const Thing& t) { s.body(t.body).set_type(BodyType::Dynamic); }},
        {"target pose",
         [](Scene& s, const Thing& t)
         {
             s.body(t.body).set_type(BodyType::Kinematic);
             s.body(t.body).set_velocity({0, -5});
         }},
    };
    for (const How& how : ways)
    {
        SCOPED_TRACE(how.name);
        Scene scene;
        const Thing support = add_static(scene, box(3, 0.5f, {0, -0.5f}));
        const BodyId body = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f)).body;
        steps(scene, 200);
        ASSERT_FALSE(scene.body(body).is_awake());
        how.go(scene, support);
        steps(scene, 60);
        EXPECT_LT(scene.body(body).position().y, -0.5) << "it falls";
    }
}

TEST(DynamicsSleep, WakesOnEveryVerbThatGivesMotion)
{
    struct How
    {
        const char* name;
        void (*act)(Scene&, BodyId);
    };
    const How ways[] = {
        {"set_velocity", [](Scene& s, BodyId b) { s.body(b).set_velocity({0, 3}); }},
        {"set_angular_velocity", [](Scene& s, BodyId b) { s.body(b).set_angular_velocity(3); }},
        {"apply_force", [](Scene& s, BodyId b) { s.body(b).apply_force({0, 50}); }},
        {"apply_force at", [](Scene& s, BodyId b) { s.body(b).apply_force({0, 50}, {0, 0.5}); }},
        {"apply_torque", [](Scene& s, BodyId b) { s.body(b).apply_torque(50); }},
        {"apply_impulse", [](Scene& s, BodyId b) { s.body(b).apply_impulse({0, 5}); }},
        {"apply_impulse at", [](Scene& s, BodyId b) { s.body(b).apply_impulse({0, 5}, {0.1, 0.5}); }},
        {"apply_angular_impulse", [](Scene& s, BodyId b) { s.body(b).apply_angular_impulse(5); }},
        {"set_awake", [](Scene& s, BodyId b) { s.body(b).set_awake(true); }},
        {"set_gravity", [](Scene& s, BodyId) { s.set_gravity({0, 5}); }},
        {"set_can_sleep", [](Scene& s, BodyId b) { s.body(b).set_can_sleep(false); }},
    };
    for (const How& how : ways)
    {
        SCOPED_TRACE(how.name);
        Scene scene;
        add_static(scene, HalfSpace{});
        const BodyId body = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f)).body;
        steps(scene, 200);
        ASSERT_FALSE(scene.body(body).is_awake());
        how.act(scene, body);
        EXPECT_TRUE(scene.body(body).is_awake());
    }
}

TEST(DynamicsSleep, WakesOnJointChanges)
{
    Scene scene;
    const BodyId body = add_dynamic(scene, {0, -2}, Circle{}).body;
    const JointId rope = scene.create_joint(DistanceDef{.body_b = body});
    scene.body(body).set_linear_damping(5);
    steps(scene, 400);
    ASSERT_FALSE(scene.body(body).is_awake()) << "a hanging ball sleeps";
    scene.joint(rope).set_def(DistanceDef{.body_b = body, .min_length = 3, .max_length = 3});
    EXPECT_TRUE(scene.body(body).is_awake());
    steps(scene, 400);
    EXPECT_NEAR(scene.body(body).position().y, -3, 0.02);
    ASSERT_FALSE(scene.body(body).is_awake());
    scene.destroy(rope);
    EXPECT_TRUE(scene.body(body).is_awake());
    steps(scene, 60);
    EXPECT_LT(scene.body(body).position().y, -3.5);
}

TEST(DynamicsSleep, SleepTakesTheTouchingAlong)
{
    Scene scene;
    add_static(scene, HalfSpace{});
    const BodyId a = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f)).body;
    const BodyId b = add_dynamic(scene, {0, 1.5}, box(0.5f, 0.5f)).body;
    steps(scene, 10);
    scene.body(a).set_awake(false);
    EXPECT_FALSE(scene.body(a).is_awake());
    EXPECT_FALSE(scene.body(b).is_awake());
    scene.body(b).set_awake(true);
    scene.step(1.0f / 60);
    EXPECT_TRUE(scene.body(a).is_awake());
}

TEST(DynamicsSleep, OneThatMayNotSleepKeepsItsIslandAwake)
{
    Scene scene;
    add_static(scene, HalfSpace{});
    const BodyId a = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f)).body;
    const BodyId b = add(scene, {.type = BodyType::Dynamic, .position = {0, 1.5}, .can_sleep = false}, box(0.5f, 0.5f)).body;
    const BodyId c = add_dynamic(scene, {9, 0.5}, box(0.5f, 0.5f)).body;
    steps(scene, 300);
    EXPECT_TRUE(scene.body(a).is_awake());
    EXPECT_TRUE(scene.body(b).is_awake());
    EXPECT_FALSE(scene.body(c).is_awake());
}

TEST(DynamicsSleep, ASleeperStruckByAFastBallReactsInTheSameStep)
{
    Scene scene({.gravity = {0, 0}});
    const BodyId sleeper = add_dynamic(scene, {0, 0}, Circle{}, {.restitution = 1}).body;
    scene.body(sleeper).set_awake(false);
    const BodyId ball = add_dynamic(scene, {-3, 0}, Circle{}, {.restitution = 1}, {300, 0}).body;
    scene.step(1.0f / 60);
    EXPECT_NEAR(scene.body(sleeper).velocity().x, 300, 0.1);
    EXPECT_NEAR(scene.body(ball).velocity().x, 0, 0.1);
    EXPECT_NEAR(scene.body(sleeper).position().x, 300.0 / 60 - 2, 0.01);
}

TEST(DynamicsSleep, AMovingKinematicBodyKeepsWhatItCarriesAwake)
{
    for (const float dt :
         {1.0f / 240, 1.0f / 60,
          1.0f / 10}) // of the last, fewer steps than lie between two looks for islands are enough to fall asleep
    {
        Scene scene;
        const BodyId lift = add(scene, {.type = BodyType::Kinematic, .velocity = {0, 0.02f}}, box(2, 0.2f, {0, -0.2f})).body;
        const BodyId cargo = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f)).body;
        const int count = static_cast<int>(std::lround(10 / dt));
        for (int i = 0; i < count; ++i)
        {
            scene.step(dt);
            ASSERT_TRUE(scene.body(cargo).is_awake()) << "step " << i << " of " << dt << " s";
        }
        EXPECT_NEAR(scene.body(cargo).position().y - scene.body(lift).position().y, 0.5, 0.01) << dt;
    }
}
