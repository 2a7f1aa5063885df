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
