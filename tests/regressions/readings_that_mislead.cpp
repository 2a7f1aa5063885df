// Symptom: a kinematic body that set_target_pose moved read a velocity of 0.

#include "regressions/numbers.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

using namespace carom;
using namespace carom::test;

TEST(Readings, AKinematicBodyThatFollowsATargetReadsItsVelocity)
{
    Scene scene(weightless());
    const BodyId lift = add(scene, {.type = BodyType::Kinematic}, box(1, 0.1f)).body;
    for (int i = 1; i <= 10; ++i)
    {
        scene.body(lift).set_target_pose({0.02 * i, 0.05 * i}, 0.01f * static_cast<float>(i));
        scene.step(dt);
        EXPECT_NEAR(scene.body(lift).velocity().x, 1.2f, 1e-4f);
        EXPECT_NEAR(scene.body(lift).velocity().y, 3, 1e-4f);
        EXPECT_NEAR(scene.body(lift).angular_velocity(), 0.6f, 1e-4f);
        EXPECT_NEAR(scene.body(lift).velocity_at({0.02 * i, 0.05 * i + 1}).x, 0.6f, 1e-3f);
    }
    scene.step(dt);
    EXPECT_EQ(scene.body(lift).velocity(), Vec2{}) << "without a new target it stands";
    EXPECT_NEAR(scene.body(lift).position().y, 0.5, 1e-6);
    scene.body(lift).set_target_pose({}, 0);
    scene.step(dt);
    scene.body(lift).set_velocity({7, 0});
    EXPECT_EQ(scene.body(lift).velocity(), (Vec2{7, 0}));
    EXPECT_EQ(scene.body(lift).angular_velocity(), 0);
}

// contacts() is of the last step; touches_now() of where the bodies stand.
TEST(Readings, TouchesNowAreOfWhereTheBodiesStand)
{
    Scene scene;
    const BodyId ground = add_static(scene, HalfSpace{}).body;
    const BodyId wall = add_static(scene, Segment{.a = {5, 0}, .b = {5, 5}}).body;
    add_static(scene, Circle{.radius = 1}, {.trigger = true});
    const BodyId body = add_dynamic(scene, {0, 0.5}, box(0.5f, 0.5f)).body;
    steps(scene, 10);
    ASSERT_EQ(scene.body(body).contacts().size(), 1u);
    ASSERT_EQ(scene.body(body).touches_now().size(), 1u);
    const ContactInfo on_ground = scene.body(body).touches_now()[0];
    EXPECT_EQ(on_ground.point_count, 2);
    EXPECT_EQ(on_ground.normal, (Vec2{0, -1})) << "from the body's own shape";
    EXPECT_NEAR(on_ground.points[0].position.y, 0, 0.001);
    EXPECT_NEAR(on_ground.points[0].separation, 0, 0.001f);
    // A jump: the step's contacts are of where it was.
    scene.body(body).teleport({0, 3}, 0);
    EXPECT_TRUE(scene.body(body).touches_now().empty());
    scene.body(body).teleport({4.5, 0.5}, 0);
    EXPECT_EQ(scene.body(body).touches_now().size(), 2u);
    EXPECT_EQ(scene.body(wall).touches_now().size(), 1u);
    EXPECT_EQ(scene.body(ground).touches_now().size(), 1u) << "a half-space looks around, too";
    scene.ignore_pair(body, wall);
    EXPECT_EQ(scene.body(body).touches_now().size(), 1u);
    // New bodies, before any step.
    const BodyId on_top = add_dynamic(scene, {4.5, 1.5}, Circle{.radius = 0.5f}).body;
    EXPECT_EQ(scene.body(on_top).touches_now().size(), 2u);
}
