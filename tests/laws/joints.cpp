// Joints: limits, motors, springs, and what they read back against statics.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

namespace {

constexpr double g = static_cast<double>(9.81f);

} // namespace

TEST(LawDistance, ARopeIsSlackThenTaut)
{
    Scene scene(sleepless());
    const BodyId ball = add_dynamic(scene, {0, -1}, Circle{.radius = 0.2f}).body;
    const JointId rope = scene.create_joint(DistanceDef{.body_b = ball, .min_length = 0, .max_length = 3});
    const double m = scene.body(ball).mass();
    // Falls free for 2 m: 0.6385 s.
    steps(scene, 30);
    EXPECT_NEAR(scene.body(ball).position().y, -1 - 0.5 * g * 0.25, 0.012) << "a jointed body is integrated sub-step by sub-step";
    EXPECT_NEAR(scene.joint(rope).force().y, 0, 1e-5) << "slack";
    double lowest = 0;
    for (int i = 0; i < 300; ++i)
    {
        scene.step(1.0f / 60);
        lowest = std::min(lowest, scene.body(ball).position().y);
    }
    EXPECT_GT(lowest, -3.1);
    EXPECT_NEAR(scene.body(ball).position().y, -3, 0.01);
    EXPECT_NEAR(scene.joint(rope).force().y, m * g, 0.01 * m * g) << "taut: it carries the ball";
}

TEST(LawDistance, ARodHoldsBothWays)
{
    Scene scene(sleepless());
    const BodyId ball = add_dynamic(scene, {0, 2}, Circle{.radius = 0.2f}).body;
    const JointId rod = scene.create_joint(DistanceDef{.body_b = ball});
    steps(scene, 60);
    EXPECT_NEAR(scene.body(ball).position().y, 2, 5e-3) << "it stands on the rod, exactly upright";
    EXPECT_NEAR(scene.joint(rod).coordinate(), 2, 5e-3);
    EXPECT_NEAR(scene.joint(rod).force().y, scene.body(ball).mass() * g, 0.01 * g);
}

TEST(LawDistance, LimitsBothEnds)
{
    for (const float v : {3.0f, -3.0f})
    {
        Scene scene(weightless());
        const BodyId ball = add_dynamic(scene, {2, 0}, Circle{.radius = 0.2f}, {}, {v, 0}).body;
        scene.create_joint(DistanceDef{.body_b = ball, .min_length = 1, .max_length = 3});
        for (int i = 0; i < 200; ++i)
        {
            scene.step(1.0f / 60);
            const double x = scene.body(ball).position().x;
            ASSERT_GT(x, 0.97);
            ASSERT_LT(x, 3.03);
        }
        EXPECT_NEAR(scene.body(ball).position().x, v > 0 ? 3 : 1, 0.02);
    }
}

TEST(LawDistance, SoftLimitsSwingAtTheirFrequency)
{
    Scene scene(weightless());
    const BodyId ball = add_dynamic(scene, {2.2, 0}, Circle{.radius = 0.2f}).body;
    scene.create_joint(DistanceDef{.body_b = ball, .min_length = 2, .max_length = 2, .hertz = 2, .damping_ratio = 0.05f});
    int crossings = 0;
    double before = 0.2;
    for (int i = 0; i < 600; ++i)
    {
        scene.step(1.0f / 240);
        const double x = scene.body(ball).position().x - 2;
        crossings += (x < 0) != (before < 0);
        before = x;
    }
    EXPECT_NEAR(crossings, 10, 1) << "2 Hz over 2.5 s";
}

TEST(LawRevolute, HoldsItsAnchorAndCarriesTheWeight)
{
    Scene scene(sleepless());
    const BodyId bar = add_dynamic(scene, {1, 0}, box(1, 0.1f), {.density = 4}).body;
    const JointId hinge = scene.create_joint(
        RevoluteDef{.body_b = bar, .anchor_b = {-1, 0}, .enable_limit = true, .lower_angle = 0, .upper_angle = 0});
    const double m = scene.body(bar).mass();
    steps(scene, 240);
    EXPECT_NEAR(scene.joint(hinge).force().y, m * g, 0.01 * m * g);
    EXPECT_NEAR(scene.joint(hinge).torque(), m * g * 1, 0.01 * m * g) << "the limit holds the moment of the weight";
    EXPECT_NEAR(scene.joint(hinge).coordinate(), 0, 0.01);
    const Position a = scene.joint(hinge).anchor_b();
    EXPECT_NEAR(std::hypot(a.x, a.y), 0, 2e-3);
}

TEST(LawRevolute, LimitsBounceByTheirRestitution)
{
    for (const float e : {0.0f, 0.5f, 1.0f})
    {
        Scene scene(weightless());
        const BodyId bar = add(scene, {.type = BodyType::Dynamic, .angular_velocity = 2}, box(1, 0.1f)).body;
        const JointId hinge = scene.create_joint(
            RevoluteDef{.body_b = bar, .enable_limit = true, .lower_angle = -1, .upper_angle = 0.5f, .limit_restitution = e});
        double most = 0;
        for (int i = 0; i < 30; ++i)
        {
            scene.step(1.0f / 60);
            most = std::max(most, static_cast<double>(scene.joint(hinge).coordinate()));
        }
        EXPECT_LT(most, 0.53) << e;
        EXPECT_NEAR(scene.body(bar).angular_velocity(), -2 * e, 0.04) << e;
    }
}

// However hard its motor drives a bat against its stop, and however softly it bounces off it.
TEST(LawRevolute, AStopHoldsUnderATorque)
{
    Scene scene(weightless());
    const BodyId bat = add(scene, {.type = BodyType::Dynamic, .angle = 0.4999f}, box(0.07f, 0.01f, {0.07f, 0})).body;
    const float torque = 2800 * scene.body(bat).mass() * (0.07f * 0.07f) * 4 / 3;
    const JointId hinge = scene.create_joint(RevoluteDef{.body_b = bat,
                                                         .enable_limit = true,
                                                         .lower_angle = -1,
                                                         .upper_angle = 0.5f,
                                                         .limit_restitution = 0.04f,
                                                         .enable_motor = true,
                                                         .motor_speed = 100,
                                                         .max_motor_torque = torque});
    for (int i = 0; i < 60; ++i)
    {
        scene.step(1.0f / 60);
        EXPECT_NEAR(scene.joint(hinge).coordinate(), 0.5, 0.001) << "step " << i;
    }
}

TEST(LawRevolute, MotorReachesItsSpeedWithItsTorque)
{
    Scene scene(weightless());
    const BodyId wheel = add_dynamic(scene, {0, 0}, Circle{}, {.density = 3}).body;
    const double inertia = scene.body(wheel).inertia();
    const JointId hinge =
        scene.create_joint(RevoluteDef{.body_b = wheel, .enable_motor = true, .motor_speed = 10, .max_motor_torque = 0.5f});
    steps(scene, 30);
    EXPECT_NEAR(scene.body(wheel).angular_velocity(), 0.5 / inertia * 0.5, 0.01);
    EXPECT_NEAR(scene.joint(hinge).torque(), 0.5, 0.01);
    steps(scene, 600);
    EXPECT_NEAR(scene.body(wheel).angular_velocity(), 10, 0.01);
    EXPECT_NEAR(scene.joint(hinge).torque(), 0, 0.01) << "nothing to do any more";
    EXPECT_NEAR(scene.joint(hinge).speed(), 10, 0.01);
}

TEST(LawRevolute, SpringSwingsAtItsFrequency)
{
    for (const float h : {1.0f / 60, 1.0f / 240})
    {
        Scene scene(weightless());
        const BodyId wheel = add_dynamic(scene, {0, 0}, Circle{}).body;
        scene.create_joint(RevoluteDef{.body_b = wheel, .spring_hertz = 2, .spring_damping_ratio = 0.05f, .spring_angle = 0.5f});
        int crossings = 0;
        double before = -0.5;
        for (int i = 0; i < static_cast<int>(5 / h); ++i)
        {
            scene.step(h);
            const double x = static_cast<double>(scene.body(wheel).angle()) - 0.5;
            crossings += (x < 0) != (before < 0);
            before = x;
        }
        EXPECT_NEAR(crossings, 20, 1) << h;
    }
}

TEST(LawPrismatic, SlidesAlongItsAxisOnly)
{
    Scene scene(sleepless());
    const BodyId body = add_dynamic(scene, {0, 0}, box(0.3f, 0.3f), {.density = 2}).body;
    const double m = scene.body(body).mass();
    const double alpha = 0.6;
    const JointId slider = scene.create_joint(PrismaticDef{
        .body_b = body, .axis_a = {static_cast<float>(2 * std::cos(alpha)), static_cast<float>(-2 * std::sin(alpha))}});
    steps(scene, 60);
    const double v = scene.joint(slider).speed();
    EXPECT_NEAR(v, g * std::sin(alpha), 0.02);
    EXPECT_NEAR(scene.joint(slider).coordinate(), 0.5 * g * std::sin(alpha), 0.06);
    const Position p = scene.body(body).position();
    EXPECT_NEAR(p.x * std::sin(alpha) + p.y * std::cos(alpha), 0, 2e-3) << "off the axis";
    EXPECT_NEAR(scene.body(body).angle(), 0, 1e-3);
    // The rail carries the part of the weight across it.
    const Vec2 f = scene.joint(slider).force();
    EXPECT_NEAR(f.x * std::sin(alpha) + f.y * std::cos(alpha), m * g * std::cos(alpha), 0.01 * m * g);
}

TEST(LawPrismatic, LimitsMotorAndSpring)
{
    Scene scene(weightless());
    const BodyId body = add_dynamic(scene, {0, 0}, box(0.3f, 0.3f)).body;
    const double m = scene.body(body).mass();
    PrismaticDef def{.body_b = body,
                     .enable_limit = true,
                     .lower_translation = -1,
                     .upper_translation = 2,
                     .enable_motor = true,
                     .motor_speed = 3,
                     .max_motor_force = 1};
    const JointId slider = scene.create_joint(def);
    steps(scene, 15);
    EXPECT_NEAR(scene.body(body).velocity().x, 1 / m * 0.25, 0.02);
    double most = 0;
    for (int i = 0; i < 240; ++i)
    {
        scene.step(1.0f / 60);
        most = std::max(most, scene.body(body).position().x);
    }
    EXPECT_LT(most, 2.03);
    EXPECT_NEAR(scene.joint(slider).coordinate(), 2, 0.02);
    def.motor_speed = -3;
    scene.joint(slider).set_def(def);
    steps(scene, 300);
    EXPECT_NEAR(scene.joint(slider).coordinate(), -1, 0.02);
    def.enable_motor = false;
    def.spring_hertz = 1;
    def.spring_damping_ratio = 1;
    def.spring_translation = 0.5f;
    scene.joint(slider).set_def(def);
    steps(scene, 300);
    EXPECT_NEAR(scene.joint(slider).coordinate(), 0.5, 0.01);
}

TEST(LawPrismatic, LimitRestitution)
{
    for (const float e : {0.0f, 0.5f, 1.0f})
    {
        Scene scene(weightless());
        const BodyId body = add_dynamic(scene, {0, 0}, box(0.3f, 0.3f), {}, {4, 0}).body;
        scene.create_joint(PrismaticDef{
            .body_b = body, .enable_limit = true, .lower_translation = -5, .upper_translation = 1, .limit_restitution = e});
        steps(scene, 30);
        EXPECT_NEAR(scene.body(body).velocity().x, -4 * e, 0.08) << e;
    }
}

TEST(LawJoints, ConnectedBodiesCollideAsAsked)
{
    for (const bool collide : {false, true})
    {
        Scene scene(weightless());
        const BodyId a = add_dynamic(scene, {0, 0}, Circle{}).body;
        const BodyId b = add_dynamic(scene, {0.5, 0}, Circle{}).body;
        scene.create_joint(SpringDef{.body_a = a, .body_b = b, .collide_connected = collide});
        steps(scene, 60);
        const double apart = scene.body(b).position().x - scene.body(a).position().x;
        if (collide)
            EXPECT_GT(apart, 0.95);
        else
            EXPECT_NEAR(apart, 0.5, 1e-5);
    }
}

TEST(LawJoints, AChainOfTwentyHangsTogether)
{
    Scene scene(sleepless());
    BodyId previous{};
    std::vector<JointId> joints;
    for (int i = 0; i < 20; ++i)
    {
        const BodyId link = add_dynamic(scene, {0.5 + i, 0}, box(0.5f, 0.1f)).body;
        joints.push_back(scene.create_joint(RevoluteDef{.body_a = previous,
                                                        .body_b = link,
                                                        .anchor_a = previous.is_null() ? Vec2{} : Vec2{0.5f, 0},
                                                        .anchor_b = {-0.5f, 0}}));
        previous = link;
    }
    double worst = 0;
    for (int i = 0; i < 600; ++i)
    {
        scene.step(1.0f / 60);
        for (const JointId j : joints)
        {
            const Vec2 gap = scene.joint(j).anchor_b() - scene.joint(j).anchor_a();
            worst = std::max(worst, static_cast<double>(length(gap)));
        }
    }
    EXPECT_LT(worst, 0.25) << "at a speed of 15 m/s at its end";
}
