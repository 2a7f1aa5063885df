// Symptom: where a wall held what a joint pulls, so that the joints of the figure yield, the springs of its other hinges went on giving the torque that
// they happened to give: no set of active rows agreed with itself, and after 64 rounds every axis kept its impulse.

#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <string>

using namespace carom;
using namespace carom::test;

namespace {

constexpr float rest_angle = 0.5f;

// A box that a rod pulls against a wall at a speed, and a lever on it whose spring wants to stand at rest_angle. Gives the lever's angle at the end.
float angle_of_lever(float speed, float hertz, float brake)
{
    Scene scene(weightless());
    scene.create_shape(scene.create_body({}), HalfSpace{.normal = {-1, 0}, .offset = 0}, {});
    const BodyId hand = scene.create_body({.type = BodyType::Kinematic, .position = {2, 0}, .velocity = {speed, 0}});
    const BodyId pulled = scene.create_body({.type = BodyType::Dynamic, .position = {-0.5, 0}});
    scene.create_shape(pulled, box(0.5f, 0.5f), {});
    const BodyId lever = scene.create_body({.type = BodyType::Dynamic, .position = {-1.5, 0}});
    scene.create_shape(lever, box(0.5f, 0.1f), {.density = 0.2f, .filter = {.mask = 0}});
    scene.create_joint(DistanceDef{.body_a = hand, .body_b = pulled, .min_length = 2.5f, .max_length = 2.5f});
    scene.create_joint(RevoluteDef{.body_a = pulled,
                                   .body_b = lever,
                                   .anchor_a = {-0.5f, 0},
                                   .anchor_b = {0.5f, 0},
                                   .enable_motor = brake > 0,
                                   .max_motor_torque = brake,
                                   .spring_hertz = hertz,
                                   .spring_damping_ratio = 0.7f,
                                   .spring_angle = rest_angle});
    for (int i = 0; i < 480; ++i)
        EXPECT_TRUE(scene.step(1.0f / 120).quarantined.empty());
    return static_cast<float>(scene.body(lever).angle() - scene.body(pulled).angle());
}

} // namespace

TEST(SpringsOfJointsThatYield, LeversStandWhereTheirSpringsWantThem)
{
    for (const float speed : {0.1f, 0.3f, 1.0f})
    {
        for (const float hertz : {1.0f, 3.0f, 10.0f})
        {
            for (const float brake : {0.0f, 0.001f})
            {
                SCOPED_TRACE("pulled at " + std::to_string(speed) + " m/s, " + std::to_string(hertz) + " Hz, brake " +
                             std::to_string(brake));
                EXPECT_NEAR(angle_of_lever(speed, hertz, brake), rest_angle, 0.02f);
            }
        }
    }
}
