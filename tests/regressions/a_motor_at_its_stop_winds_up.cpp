// Symptom: a motor that had pressed a hinge or slider against its stop for 10 s waited for 9.8 s when it was reversed.

#include "regressions/numbers.h"
#include "support/test_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <variant>

using namespace carom;
using namespace carom::test;

namespace {

/// A bar or a carriage with a motor, some bodies hinged to it, and what its motor may give.
struct Machine
{
    Scene scene{sleepless()};
    JointId driven;

    Machine(bool hinge, float strength, int others, BodyId base = {})
    {
        if (base.is_null() && others % 2 == 1)
        {
            base = scene.create_body({.type = BodyType::Dynamic, .position = {0, -2}});
            scene.create_shape(base, box(1, 0.2f), {.density = 100, .filter = {.mask = 0}});
            scene.create_joint(PrismaticDef{.body_b = base,
                                            .anchor_a = {0, -2},
                                            .axis_a = {1, 0},
                                            .enable_limit = true}); // held by a stop, so that both bodies of the motor may move
        }
        const Vec2 at = base.is_null() ? Vec2{} : Vec2{0, 2};
        const BodyId body = scene.create_body({.type = BodyType::Dynamic, .position = {hinge ? 0.5 : 0.0, 0}});
        scene.create_shape(body, box(0.5f, 0.1f), {.density = 10, .filter = {.mask = 0}});
        if (hinge)
            driven = scene.create_joint(RevoluteDef{.body_a = base,
                                                    .body_b = body,
                                                    .anchor_a = at,
                                                    .anchor_b = {-0.5f, 0},
                                                    .enable_limit = true,
                                                    .lower_angle = -0.3f,
                                                    .upper_angle = 0.3f,
                                                    .enable_motor = true,
                                                    .motor_speed = 2,
                                                    .max_motor_torque = strength});
        else
            driven = scene.create_joint(PrismaticDef{.body_a = base,
                                                     .body_b = body,
                                                     .anchor_a = at,
                                                     .axis_a = {0, 1},
                                                     .enable_limit = true,
                                                     .lower_translation = -0.3f,
                                                     .upper_translation = 0.3f,
                                                     .enable_motor = true,
                                                     .motor_speed = 2,
                                                     .max_motor_force = strength});
        BodyId last = body;
        for (int i = 0; i < others; ++i)
        {
            const BodyId next = scene.create_body({.type = BodyType::Dynamic, .position = {hinge ? 1.0 : 0.5, -0.1 - 0.2 * i}});
            scene.create_shape(next, box(0.03f, 0.1f), {.filter = {.mask = 0}});
            scene.create_joint(RevoluteDef{
                .body_a = last, .body_b = next, .anchor_a = i == 0 ? Vec2{0.5f, 0} : Vec2{0, -0.1f}, .anchor_b = {0, 0.1f}});
            last = next;
        }
    }

    void reverse()
    {
        JointDef def = scene.joint(driven).def();
        if (auto* hinge = std::get_if<RevoluteDef>(&def))
            hinge->motor_speed = -hinge->motor_speed;
        else
            std::get<PrismaticDef>(def).motor_speed *= -1;
        scene.joint(driven).set_def(def);
    }
};

} // namespace

TEST(MotorAtItsStop, TurnsBackAtOnceWhenItIsReversed)
{
    for (const bool hinge : {true, false})
    {
        for (const float strength : {60.0f, 1000.0f, 1e6f})
        {
            for (const int others : {0, 1, 4, 40})
            {
                for (const int seconds : {1, 10, 60})
                {
                    if (seconds == 60 && others > 1)
                        continue;
                    SCOPED_TRACE((hinge ? "hinge, " : "slider, ") + std::to_string(strength) + ", " + std::to_string(others) +
                                 " others, after " + std::to_string(seconds) + " s");
                    Machine machine(hinge, strength, others);
                    steps(machine.scene, 60 * seconds);
                    const ConstJoint joint = std::as_const(machine.scene).joint(machine.driven);
                    EXPECT_NEAR(joint.coordinate(), 0.3f, 0.005f);
                    machine.reverse();
                    steps(machine.scene, 3);
                    EXPECT_LT(joint.coordinate(), 0.28f);
                    steps(machine.scene, 57);
                    EXPECT_NEAR(joint.coordinate(), -0.3f, 0.005f);
                }
            }
        }
    }
}

// At the stop the motor gives all it has, and the stop the rest.
TEST(MotorAtItsStop, IsReadAsTheLoad)
{
    Machine machine(true, 1000, 0);
    steps(machine.scene, 120);
    const ConstJoint joint = std::as_const(machine.scene).joint(machine.driven);
    const double m = d(machine.scene.body(joint.body_b()).mass());
    EXPECT_NEAR(d(joint.torque()), m * 9.81 * 0.5 * std::cos(0.3), 0.01 * m * 9.81)
        << "of motor and stop together, the bar's weight";
}
