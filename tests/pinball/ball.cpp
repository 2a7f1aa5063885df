// The ball: rolling on the playfield and bouncing off walls. Expected numbers are closed forms.

#include "bench_table.h"
#include "pinball/elements/rolling.h"

#include <cmath>
#include <gtest/gtest.h>

namespace carom::pinball::test {
namespace {

const float slope_acceleration = 9.81f * std::sin(radians(6.5f)); // 1.1105 m/s²

double seconds_to_fall(Playfield& field, double distance)
{
    const double start = field.balls().front().state.position.y;
    for (int i = 1; i < 5000; ++i)
    {
        field.step({});
        if (start - field.balls().front().state.position.y >= distance)
            return i * 0.001;
    }
    return 0;
}

TEST(Ball, RollsDownTheTableFromRestAtFiveSeventhsOfTheSlope)
{
    const Table table = bare_table();
    Playfield field(table, 1);
    shoot(field, {1, 2}, {});
    EXPECT_NEAR(seconds_to_fall(field, 1.07), 1.643, 0.0025);
    const BallState& ball = field.balls().front().state;
    EXPECT_NEAR(-ball.velocity.y, 1.303f, 0.003f);
    EXPECT_NEAR(ball.rolling.y, ball.velocity.y, 1e-4f);
}

TEST(Ball, SlidesDownAPlayfieldWithoutFriction)
{
    const Table table = bare_table(6.5f, 0);
    Playfield field(table, 1);
    shoot(field, {1, 2}, {});
    EXPECT_NEAR(seconds_to_fall(field, 1.07), 1.388, 0.0025);
    EXPECT_EQ(field.balls().front().state.rolling, Vec2{});
}

TEST(Ball, OnTooSlipperyAPlayfieldRollsAndSlides)
{
    // Below mu = 2/7 tan(slope) = 0.0326 friction cannot hold the rolling: a = g (sin - mu cos).
    const Table table = bare_table(6.5f, 0.02f);
    Playfield field(table, 1);
    shoot(field, {1, 2}, {});
    run(field, 1000);
    EXPECT_NEAR(-field.balls().front().state.velocity.y, slope_acceleration - 0.02f * 9.81f * std::cos(radians(6.5f)), 0.002f);
}

TEST(Ball, ASlideEndsInRollingAtFiveSeventhsOfItsSpeed)
{
    for (const auto& [mu, time, distance] : {std::tuple{0.2f, 0.291f, 0.499f}, std::tuple{0.1f, 0.582f, 0.999f}})
    {
        const Table table = bare_table(0, mu);
        Playfield field(table, 1);
        shoot(field, {0.2f, 1}, {2, 0});
        run(field, static_cast<int>(time * 1000) + 1);
        const BallState& ball = field.balls().front().state;
        EXPECT_NEAR(ball.velocity.x, 2 * 5.0f / 7, 0.002f) << mu;
        EXPECT_NEAR(ball.rolling.x, ball.velocity.x, 0.002f) << mu;
        EXPECT_NEAR(ball.position.x - 0.2, distance, 0.003) << mu;
        const float rolling_speed = ball.velocity.x;
        run(field, 100);
        EXPECT_NEAR(field.balls().front().state.velocity.x, rolling_speed, 0.001f);
    }
}

/// Throws a ball at a wall below it on a level playfield without friction and gives it back after the bounce.
BallState bounce(float friction, float restitution, Vec2 velocity)
{
    Table table = bare_table(0, 0);
    table.materials[wall_material] = {.name = "wall", .restitution = restitution, .friction = friction};
    add(table, wall({0, 1}, {2, 1}));
    Playfield field(table, 1);
    shoot(field, {1, 1.03f}, velocity);
    run(field, 60);
    return field.balls().front().state;
}

TEST(Ball, AGrippingBounceLeavesFiveSeventhsOfTheSidewaysSpeed)
{
    const BallState ball = bounce(0.9f, 0.5f, {0.5f, -1});
    EXPECT_NEAR(ball.velocity.y, 0.5f, 0.005f);
    EXPECT_NEAR(ball.velocity.x, 0.5f * 5 / 7, 0.003f);
    EXPECT_NEAR(std::abs(ball.spin), 5 * 0.5f / (7 * 0.0135f), 0.3f);
    EXPECT_NEAR(ball.velocity.x + ball.spin * 0.0135f, 0, 0.003f) << "the touching point is at rest";
}

TEST(Ball, ASlippingBounceLosesFrictionTimesTheChangeOfNormalSpeed)
{
    const BallState ball = bounce(0.1f, 0.5f, {2, -1});
    EXPECT_NEAR(ball.velocity.y, 0.5f, 0.005f);
    EXPECT_NEAR(ball.velocity.x, 2 - 0.1f * 1.5f, 0.003f);
}

TEST(Ball, BouncesByTheWallsMaterialAlone)
{
    Table table = bare_table(0, 0);
    table.materials[ball_material].restitution = 0.9f;
    table.materials[wall_material] = {.name = "wall", .restitution = 0.3f, .friction = 0};
    add(table, wall({0, 1}, {2, 1}));
    Playfield field(table, 1);
    shoot(field, {1, 1.03f}, {0, -1});
    run(field, 60);
    EXPECT_NEAR(field.balls().front().state.velocity.y, 0.3f, 0.003f);
}

TEST(Ball, RestitutionFallsWithTheSpeedOfImpact)
{
    Table table = bare_table(0, 0);
    Material& rubber = table.materials[wall_material];
    rubber.friction = 0;
    rubber.curve.points = {{{0, 0.9f}, {0.5f, 0.8f}, {1, 0.7f}, {2, 0.5f}}};
    rubber.curve.count = 4;
    add(table, wall({0, 1}, {2, 1}));
    for (const auto& [speed, restitution] : {std::pair{0.5f, 0.8f}, {1.5f, 0.6f}, {3.0f, 0.5f}})
    {
        Playfield field(table, 1);
        shoot(field, {1, 1.1f}, {0, -speed});
        run(field, 300);
        EXPECT_NEAR(field.balls().front().state.velocity.y, restitution * speed, 0.01f * speed);
    }
}

TEST(Ball, DroppedOnRubberItRisesLessEachTime)
{
    Table table = bare_table();
    table.materials[wall_material] = {.name = "wall", .restitution = 0.8f, .friction = 0.5f};
    add(table, wall({0, 1}, {2, 1}));
    Playfield field(table, 1);
    shoot(field, {1, 1.3f}, {});
    double top = 1.3;
    double highest = 0;
    int bounces = 0;
    for (int i = 0; i < 6000; ++i)
    {
        field.step({});
        const BallState& ball = field.balls().front().state;
        highest = std::max(highest, ball.position.y);
        if (count(field.events(), EventKind::Impact) == 0)
            continue;
        if (++bounces > 1)
        {
            EXPECT_LT(highest, top + 1e-4) << bounces;
            top = highest;
        }
        highest = 0;
    }
    EXPECT_GT(bounces, 3);
    EXPECT_NEAR(field.balls().front().state.position.y, 1.0135, 0.0005);
    EXPECT_LT(length(field.balls().front().state.velocity), 0.002f);
}

TEST(Ball, AWallRubsOnTheRollOfTheBallThatStrikesIt)
{
    EXPECT_EQ(rub_wall({1, 0}, {0, 1}, 5).x, 1) << "roll along the wall is not touched";
    EXPECT_NEAR(rub_wall({0, -1}, {0, 1}, 5).y, -2.0f / 7, 1e-6f) << "all the friction there can be";
    EXPECT_NEAR(rub_wall({0, -1}, {0, 1}, 0.1f).y, -0.75f, 1e-6f) << "as much as the impulse allows";
}

TEST(Ball, TwoBallsRubTheirRollsAlike)
{
    Vec2 a{1, 0};
    Vec2 b{};
    rub_balls(a, b, {1, 0}, 0.02f);
    EXPECT_NEAR(a.x, 0.95f, 1e-6f);
    EXPECT_NEAR(b.x, -0.05f, 1e-6f);
    Vec2 c{1, 0};
    Vec2 d{-1, 0};
    rub_balls(c, d, {1, 0}, 5);
    EXPECT_EQ(c.x, 1) << "faces that move alike do not rub";
}

TEST(Ball, ThreeBallsInARowPassTheImpulseOn)
{
    // Striker at 1 m/s, two captive balls that do not quite touch, e = 0.9: 0.050, 0.047, 0.902 m/s.
    Table table = bare_table(0, 0);
    table.materials[ball_material] = {.name = "ball", .restitution = 0.9f, .friction = 0};
    Playfield field(table, 1);
    shoot(field, {0.900f, 1}, {1, 0});
    shoot(field, {1.000f, 1}, {});
    shoot(field, {1.029f, 1}, {});
    run(field, 200);
    const auto& balls = field.balls();
    EXPECT_NEAR(balls[0].state.velocity.x, 0.050f, 0.002f);
    EXPECT_NEAR(balls[1].state.velocity.x, 0.047f, 0.003f);
    EXPECT_NEAR(balls[2].state.velocity.x, 0.902f, 0.003f);
}

/// Kinetic energy of the three spins and the velocity, and height.
double energy(const BallState& ball)
{
    const double m = 0.08;
    const double v2 = double{dot(ball.velocity, ball.velocity)};
    const double rolling2 = double{dot(ball.rolling, ball.rolling)};
    const double spin = double{ball.spin} * 0.0135;
    return 0.5 * m * (v2 + 0.4 * (rolling2 + spin * spin)) + m * double{slope_acceleration} * ball.position.y;
}

TEST(Ball, GainsNoEnergyOnAPassiveTable)
{
    Table table = bare_table();
    table.materials[wall_material] = {.name = "wall", .restitution = 0.85f, .friction = 0.6f};
    add(table, wall({0.8f, 0.5f}, {0.8f, 2}));
    add(table, wall({1.2f, 0.5f}, {1.2f, 2}));
    add(table, wall({0.8f, 1.1f}, {1.1f, 0.9f}));
    add(table, Post{{1.0f, 1.3f}, 0.02f});
    Playfield field(table, 1);
    shoot(field, {1.002f, 1.7f}, {0.8f, 0.1f});
    double before = energy(field.balls().front().state);
    while (field.balls().front().state.position.y > 0.6)
    {
        field.step({});
        const double now = energy(field.balls().front().state);
        ASSERT_LE(now, before + 2e-6 * before + 1e-6) << field.step_count();
        before = now;
        ASSERT_LT(field.step_count(), 60'000) << "it never came down";
    }
}

TEST(Ball, MovesTheSameAtOneTwoAndFourKilohertz)
{
    Position ends[3];
    int i = 0;
    for (const float step : {0.001f, 0.0005f, 0.00025f})
    {
        Table table = bare_table();
        table.physics.step = step;
        Playfield field(table, 1);
        shoot(field, {1, 1}, {0.5f, 1.5f});
        run(field, static_cast<int>(0.5f / step + 0.5f));
        ends[i++] = field.balls().front().state.position;
    }
    EXPECT_LT(length(ends[0] - ends[2]), 0.001f);
    EXPECT_LT(length(ends[1] - ends[2]), 0.001f);
}

} // namespace
} // namespace carom::pinball::test
