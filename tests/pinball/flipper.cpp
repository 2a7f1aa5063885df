// The flipper against the formulas of a bat turned by a torque.

#include "bench_table.h"

#include <cmath>
#include <gtest/gtest.h>

namespace carom::pinball::test {
namespace {

// Rise of the coil and end-of-stroke switch are taken out where a formula does not know them.
Flipper plain_flipper()
{
    return {.pivot = {1, 1},
            .length = 0.0621f,
            .base_radius = 0.0109f,
            .tip_radius = 0.0065f,
            .rest = radians(-31),
            .up = radians(16),
            .inertia = 0.000103f,
            .coil_torque = 0.8f,
            .coil_rise = 0,
            .hold_torque_ratio = 1,
            .eos = 0,
            .return_ratio = 0.06f,
            .stop_restitution = 0.3f,
            .input = Side::Left};
}

Flipper mirrored(Flipper flipper)
{
    flipper.rest = pi - flipper.rest;
    flipper.up = pi - flipper.up;
    flipper.input = Side::Right;
    return flipper;
}

constexpr Buttons both{.left = true, .right = true};

struct Stroke
{
    int steps = 0;
    float end_speed = 0;
};

Stroke stroke(const Flipper& def, const Buttons& buttons, int steps_before = 50)
{
    Table table = bare_table();
    const Index index = add(table, def);
    Playfield field(table, 1);
    run(field, steps_before);
    for (int i = 1; i < 1000; ++i)
    {
        field.step(buttons);
        for (const GameEvent& event : field.events())
            if (event.kind == EventKind::FlipperStop && event.element == index && event.value == 1)
                return {i, event.speed};
    }
    return {};
}

TEST(Flipper, StrokeWithoutRiseTakesTheTimeOfTheFormula)
{
    const Flipper def = plain_flipper();
    const float angle = radians(47);
    const float time = std::sqrt(2 * angle * def.inertia / def.coil_torque);
    const float speed = std::sqrt(2 * def.coil_torque * angle / def.inertia);
    for (const Flipper& flipper : {def, mirrored(def)})
    {
        const Stroke s = stroke(flipper, both);
        EXPECT_NEAR(static_cast<float>(s.steps) * 0.001f, time, 0.0011f);
        EXPECT_LE(s.end_speed, speed * 1.001f);
        EXPECT_GE(s.end_speed, speed - 0.001f * def.coil_torque / def.inertia - 0.1f) << "one step before the stop";
    }
}

TEST(Flipper, SleepsAtItsStopsAndStrikesFromSleepAsFromRest)
{
    Flipper def = plain_flipper();
    def.coil_rise = 0.015f;
    Table table = bare_table();
    const Index index = add(table, def);
    Playfield field(table, 1);
    const auto sleeps = [&] { return !field.scene().body(field.state(index).body).is_awake(); };
    run(field, 2000);
    EXPECT_TRUE(sleeps()) << "at the lower stop";
    run(field, 1, both);
    EXPECT_FALSE(sleeps()) << "the button";
    run(field, 2000, both);
    EXPECT_TRUE(sleeps()) << "held up";
    EXPECT_NEAR(field.state(index).angle, def.up, 1e-3f);
    run(field, 1);
    EXPECT_FALSE(sleeps()) << "let go";
    run(field, 500);
    EXPECT_NEAR(field.state(index).angle, def.rest, 1e-3f);

    const Stroke from_rest = stroke(def, both, 50);
    const Stroke from_sleep = stroke(def, both, 5000);
    EXPECT_EQ(from_rest.steps, from_sleep.steps);
    EXPECT_NEAR(from_rest.end_speed, from_sleep.end_speed, 1e-4f * from_rest.end_speed);
}

TEST(Flipper, SpeedFollowsTheTorqueAllTheWayUp)
{
    const Flipper def = plain_flipper();
    const float acceleration = def.coil_torque / def.inertia;
    Table table = bare_table();
    const Index index = add(table, def);
    Playfield field(table, 1);
    for (int i = 1; i <= 13; ++i)
    {
        field.step(both);
        const float time = 0.001f * static_cast<float>(i);
        EXPECT_NEAR(field.state(index).speed, acceleration * time, 0.05f);
        EXPECT_NEAR(field.state(index).angle - def.rest, 0.5f * acceleration * time * time, 1e-5f);
    }
}

TEST(Flipper, StrokeOfTheTableTakes22MillisecondsAndEndsAt108RadiansPerSecond)
{
    Flipper def = plain_flipper();
    def.coil_rise = 0.015f;
    const Stroke s = stroke(def, both);
    // 21.4 ms, and 0.9 ms in which the rising coil overcomes the return spring; the strike falls into the 23rd step.
    EXPECT_EQ(s.steps, 23);
    EXPECT_GT(s.end_speed, 107.8f - 10) << "up to a step before the stop";
    EXPECT_LE(s.end_speed, 108.0f);
}

/// Seconds until the bat has turned by most of its stroke, between the steps where need be.
float time_to_turn(float step, float angle)
{
    Flipper def = plain_flipper();
    def.coil_rise = 0.015f;
    Table table = bare_table();
    table.physics.step = step;
    const Index index = add(table, def);
    Playfield field(table, 1);
    float before = 0;
    for (int i = 1; i < 500; ++i)
    {
        field.step(both);
        const float turned = field.state(index).angle - def.rest;
        if (turned >= angle)
            return step * (static_cast<float>(i) - (turned - angle) / (turned - before));
        before = turned;
    }
    return 0;
}

TEST(Flipper, StrokeTakesTheSameTimeAtOneTwoAndFourKilohertz)
{
    const float angle = radians(45);
    const float fine = time_to_turn(0.00025f, angle);
    EXPECT_GT(fine, 0.018f);
    EXPECT_NEAR(time_to_turn(0.001f, angle), fine, 0.01f * fine);
    EXPECT_NEAR(time_to_turn(0.0005f, angle), fine, 0.01f * fine);
}

TEST(Flipper, ReturnsSlowerThanItStrikesAndRestsOnItsStop)
{
    Table table = bare_table();
    const Index index = add(table, plain_flipper());
    Playfield field(table, 1);
    run(field, 200, both);
    EXPECT_NEAR(field.state(index).angle, radians(16), radians(0.1f));
    int steps = 0;
    for (; steps < 500; ++steps)
    {
        field.step({});
        if (count(field.events(), EventKind::FlipperStop) > 0)
            break;
    }
    EXPECT_GT(steps, 45) << "four times the stroke of 14 ms";
    EXPECT_LT(steps, 90);
    run(field, 500);
    EXPECT_NEAR(field.state(index).angle, radians(-31), radians(0.1f));
    EXPECT_NEAR(field.state(index).speed, 0, 0.01f);
}

TEST(Flipper, BouncesOffItsStopWithTheStopsRestitution)
{
    Table table = bare_table();
    Flipper def = plain_flipper();
    def.return_ratio = 0;
    const Index index = add(table, def);
    Playfield field(table, 1);
    field.scene().body(field.state(index).body).set_angular_velocity(40);
    float fastest_back = 0;
    for (int i = 0; i < 40; ++i)
    {
        field.step({});
        fastest_back = std::min(fastest_back, field.state(index).speed);
    }
    EXPECT_NEAR(fastest_back, -0.3f * 40, 0.5f);
}

double momentum_about_pivot(const Playfield& field, Index flipper, const Flipper& def)
{
    const BallState& ball = field.balls().front().state;
    const Vec2 arm = ball.position - Position(def.pivot);
    return double{field.table().ball.mass} * double{cross(arm, ball.velocity)} +
           0.4 * 0.08 * 0.0135 * 0.0135 * double{ball.spin} + double{def.inertia} * double{field.state(flipper).speed};
}

TEST(Flipper, AHitOffTheStopsKeepsTheAngularMomentumAboutThePivot)
{
    Flipper def = plain_flipper();
    def.coil_torque = 1e-9f;
    Table table = bare_table(0, 0);
    table.materials[wall_material] = {.name = "rubber", .restitution = 0.8f, .friction = 0.8f};
    const Index index = add(table, def);
    for (const float along : {0.03f, 0.045f, 0.06f})
    {
        Playfield field(table, 1);
        // Above the bat, where it comes by in the middle of its stroke.
        shoot(field, {1 + along, 1.03f}, {0, 0});
        field.scene().body(field.state(index).body).set_angular_velocity(60);
        const double before = 0.000103 * 60;
        ASSERT_TRUE(run_until(field, EventKind::Impact, 30));
        EXPECT_NEAR(momentum_about_pivot(field, index, def), before, 2e-4 * before) << along;
        EXPECT_GT(field.balls().front().state.velocity.y, 1.0f) << along;
    }
}

TEST(Flipper, OnItsStopItIsAsHardAsAWall)
{
    Flipper def = plain_flipper();
    Table table = bare_table(0, 0);
    table.materials[wall_material] = {.name = "rubber", .restitution = 0.8f, .friction = 0};
    add(table, def);
    const Rotation rest = Rotation::from_angle(def.rest);
    const Vec2 along = rotate(rest, {1, 0});
    // The face is tilted against the middle line by the taper.
    const float tilt = std::asin((def.base_radius - def.tip_radius) / def.length);
    const Vec2 normal = rotate(Rotation::from_angle(def.rest + 0.5f * pi - tilt), {1, 0});
    Playfield field(table, 1);
    run(field, 100);
    const Vec2 start = def.pivot + 0.04f * along + 0.05f * normal;
    shoot(field, start, -1.0f * normal);
    ASSERT_TRUE(run_until(field, EventKind::Impact, 100));
    run(field, 1);
    EXPECT_NEAR(dot(field.balls().front().state.velocity, normal), 0.8f, 0.01f);
}

TEST(Flipper, HoldsABallStill)
{
    Flipper def = plain_flipper();
    def.coil_rise = 0.015f;
    def.hold_torque_ratio = 0.3f;
    def.eos = radians(6);
    Table table = bare_table();
    table.materials[wall_material] = {.name = "rubber", .restitution = 0.5f, .friction = 0.8f};
    add(table, def);
    add(table, wall({0.975f, 1.3f}, {0.99f, 1.0125f}));
    Playfield field(table, 1);
    run(field, 100, both);
    shoot(field, {1.02f, 1.06f}, {});
    run(field, 1500, both);
    const Position rests = field.balls().front().state.position;
    EXPECT_GT(rests.y, 1.0);
    for (int i = 0; i < 10'000; ++i)
    {
        field.step(both);
        ASSERT_LT(length(field.balls().front().state.velocity), 0.001f) << i;
    }
    EXPECT_LT(length(field.balls().front().state.position - rests), 0.0001f);
}

TEST(Flipper, ShootsARollingBallUpTheTable)
{
    Flipper def = plain_flipper();
    def.coil_rise = 0.015f;
    def.hold_torque_ratio = 0.3f;
    def.eos = radians(6);
    Table table = bare_table();
    table.materials[wall_material] = {.name = "rubber", .restitution = 0.85f, .friction = 0.8f};
    add(table, def);
    Playfield field(table, 1);
    const Vec2 along = rotate(Rotation::from_angle(def.rest), {1, 0});
    const Vec2 normal = perp(along);
    shoot(field, def.pivot + 0.035f * along + 0.024f * normal, 0.2f * along, true);
    run(field, 30);
    run(field, 60, both);
    const float speed = length(field.balls().front().state.velocity);
    EXPECT_GT(speed, 1.5f);
    EXPECT_LT(speed, 4.0f);
    EXPECT_GT(field.balls().front().state.velocity.y, 1.0f);
}

TEST(Flipper, WithoutPowerItStaysDown)
{
    Table table = bare_table();
    const Index index = add(table, plain_flipper());
    Playfield field(table, 1);
    field.command(index, Command::Disable);
    run(field, 100, both);
    EXPECT_NEAR(field.state(index).angle, radians(-31), radians(0.1f));
    field.command(index, Command::Enable);
    run(field, 100, both);
    EXPECT_NEAR(field.state(index).angle, radians(16), radians(0.1f));
}

TEST(Flipper, NoBallPassesThroughASwingingBat)
{
    Flipper def = plain_flipper();
    Table table = bare_table();
    table.materials[wall_material] = {.name = "rubber", .restitution = 0.85f, .friction = 0.8f};
    add(table, def);
    int below = 0;
    for (int i = 0; i < 40; ++i)
    {
        Playfield field(table, 1);
        const float along = 0.02f + 0.001f * static_cast<float>(i);
        shoot(field, {1 + along, 1.15f}, {0, -4 - 0.1f * static_cast<float>(i)});
        run(field, 15 + i % 8);
        run(field, 40, both);
        // Whatever it does, it has to be above the line of the raised bat, or out beyond its tip.
        const BallState& ball = field.balls().front().state;
        const Vec2 p = ball.position - Position(def.pivot);
        const bool under = p.y < 0 && p.x > -0.02f && p.x < 0.05f;
        below += under ? 1 : 0;
    }
    EXPECT_EQ(below, 0);
}

} // namespace
} // namespace carom::pinball::test
