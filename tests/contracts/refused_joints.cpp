// Joints: what their definitions refuse.

#include "contracts/contract.h"

using namespace carom;
using namespace carom::test;

TEST_F(Contract, NumbersOfJoints)
{
    for (const float bad : {not_a_number, infinite, -infinite})
    {
        joint_refused(SpringDef{.body_a = ball.body, .anchor_a = {bad, 0}}, "anchor_a");
        joint_refused(SpringDef{.body_a = ball.body, .anchor_b = {bad, 0}}, "anchor_b");
        joint_refused(SpringDef{.body_a = ball.body, .length = bad}, "length");
        joint_refused(DistanceDef{.body_a = ball.body, .min_length = bad}, "min_length");
        joint_refused(DistanceDef{.body_a = ball.body, .max_length = bad}, "max_length");
        joint_refused(RevoluteDef{.body_a = ball.body, .reference_angle = bad}, "reference_angle");
        joint_refused(RevoluteDef{.body_a = ball.body, .lower_angle = bad}, "lower_angle");
        joint_refused(RevoluteDef{.body_a = ball.body, .upper_angle = bad}, "upper_angle");
        joint_refused(RevoluteDef{.body_a = ball.body, .motor_speed = bad}, "motor_speed");
        joint_refused(RevoluteDef{.body_a = ball.body, .spring_angle = bad}, "spring_angle");
        joint_refused(PrismaticDef{.body_a = ball.body, .axis_a = {bad, 0}}, "axis_a");
        joint_refused(PrismaticDef{.body_a = ball.body, .reference_angle = bad}, "reference_angle");
        joint_refused(PrismaticDef{.body_a = ball.body, .lower_translation = bad}, "lower_translation");
        joint_refused(PrismaticDef{.body_a = ball.body, .upper_translation = bad}, "upper_translation");
        joint_refused(PrismaticDef{.body_a = ball.body, .motor_speed = bad}, "motor_speed");
        joint_refused(PrismaticDef{.body_a = ball.body, .spring_translation = bad}, "spring_translation");
        joint_refused(WeldDef{.body_a = ball.body, .anchor_b = {0, bad}}, "anchor_b");
        joint_refused(WeldDef{.body_a = ball.body, .reference_angle = bad}, "reference_angle");
    }
    for (const float bad : {not_a_number, infinite, -infinite, -1.0f})
    {
        joint_refused(SpringDef{.body_a = ball.body, .stiffness = bad}, "stiffness");
        joint_refused(SpringDef{.body_a = ball.body, .damping = bad}, "damping");
        joint_refused(DistanceDef{.body_a = ball.body, .hertz = bad}, "hertz");
        joint_refused(DistanceDef{.body_a = ball.body, .damping_ratio = bad}, "damping_ratio");
        joint_refused(RevoluteDef{.body_a = ball.body, .limit_restitution = bad}, "limit_restitution");
        joint_refused(RevoluteDef{.body_a = ball.body, .max_motor_torque = bad}, "max_motor_torque");
        joint_refused(RevoluteDef{.body_a = ball.body, .spring_hertz = bad}, "spring_hertz");
        joint_refused(RevoluteDef{.body_a = ball.body, .spring_damping_ratio = bad}, "spring_damping_ratio");
        joint_refused(PrismaticDef{.body_a = ball.body, .limit_restitution = bad}, "limit_restitution");
        joint_refused(PrismaticDef{.body_a = ball.body, .max_motor_force = bad}, "max_motor_force");
        joint_refused(PrismaticDef{.body_a = ball.body, .spring_hertz = bad}, "spring_hertz");
        joint_refused(PrismaticDef{.body_a = ball.body, .spring_damping_ratio = bad}, "spring_damping_ratio");
    }
}

TEST_F(Contract, RangesOfJoints)
{
    joint_refused(DistanceDef{.body_a = ball.body, .min_length = 3, .max_length = 2}, "max_length");
    joint_refused(RevoluteDef{.body_a = ball.body, .enable_limit = true, .lower_angle = 1, .upper_angle = 0}, "_angle");
    joint_refused(PrismaticDef{.body_a = ball.body, .enable_limit = true, .lower_translation = 1, .upper_translation = 0},
                  "_translation");
    joint_refused(PrismaticDef{.body_a = ball.body, .axis_a = {0, 0}}, "axis_a");
    joint_refused(RevoluteDef{.body_a = ball.body, .limit_restitution = 1.5f}, "limit_restitution");
}

TEST_F(Contract, EndsOfJoints)
{
    joint_refused(SpringDef{}, "body");                                         // the world and the world
    joint_refused(SpringDef{.body_a = ball.body, .body_b = ball.body}, "body"); // a body with itself
    joint_refused(SpringDef{.body_a = gone.body}, "body_a");
    joint_refused(RevoluteDef{.body_a = ball.body, .body_b = gone.body}, "body_b");
    // Another kind, other bodies.
    refused([&] { scene.joint(joint).set_def(RevoluteDef{.body_a = ball.body, .body_b = crate.body}); }, {"Joint::set_def"});
    refused([&] { scene.joint(joint).set_def(SpringDef{.body_a = ball.body}); }, {"Joint::set_def"});
    refused([&] { scene.joint(joint).set_def(SpringDef{.body_a = ball.body, .body_b = crate.body, .stiffness = -1}); },
            {"Joint::set_def", "stiffness"});
}
