// The plunger as mechanics has it: rod and ball share what the spring gives.

#include "bench_table.h"

#include <cmath>
#include <gtest/gtest.h>

namespace carom::pinball::test {
namespace {

struct Launch
{
    float ball_speed = 0;
    float pulled = 0;
};

Table lane(float damping, float slope_deg, float mu)
{
    Table table = bare_table(slope_deg, mu);
    table.materials[wall_material] = {.name = "steel", .restitution = 0, .friction = 0};
    const Index sensor = add(table, Sensor{.pos = {1, 0.53f}, .half = {0.018f, 0.02f}});
    add(table, Plunger{.pos = {1, 0.5f},
                       .half = {0.01f, 0.01f},
                       .axis = {0, 1},
                       .stroke = 0.05f,
                       .mass = 0.15f,
                       .k = 620,
                       .c = damping,
                       .preload = 2,
                       .pull_speed = 0.09f,
                       .lane = sensor});
    return table;
}

/// The greatest speed of a ball that lies on the rod, after a pull of so many steps.
Launch launch(const Table& table, int pull_steps)
{
    Playfield field(table, 1);
    field.add_ball({1, 0.5237f});
    run(field, pull_steps, {.plunger = true});
    Launch result{.pulled = field.state(1).travel};
    for (int i = 0; i < 100; ++i)
    {
        field.step({});
        result.ball_speed = std::max(result.ball_speed, field.balls().front().state.velocity.y);
    }
    return result;
}

TEST(Plunger, SharesTheSpringsEnergyBetweenRodAndBall)
{
    // Without friction and damping: (m_rod + m_ball) v² / 2 = k x² / 2 + F0 x - (m_rod + m_ball) g sin(slope) x.
    // Pulled so slowly that the ball lies on the rod when it is let go.
    Table table = lane(0, 6.5f, 0);
    std::get<Plunger>(table.elements[1].part).pull_speed = 0.03f;
    for (const int steps : {345, 675, 1005, 1335, 1800})
    {
        const Launch l = launch(table, steps);
        const float weight = (0.15f + 0.08f) * 9.81f * std::sin(radians(6.5f));
        const float work = 0.5f * 620 * l.pulled * l.pulled + (2 - weight) * l.pulled;
        EXPECT_NEAR(l.ball_speed, std::sqrt(2 * work / (0.15f + 0.08f)), 0.02f * l.ball_speed + 0.01f) << l.pulled;
    }
}

TEST(Plunger, PullsAtItsSpeedUpToItsStroke)
{
    const Table table = lane(0, 6.5f, 0.12f);
    EXPECT_NEAR(launch(table, 200).pulled, 0.018f, 0.0005f);
    EXPECT_NEAR(launch(table, 900).pulled, 0.05f, 0.0005f);
}

TEST(Plunger, AFullPlungeOfTheTableIsWithinTheBandOfRealOnes)
{
    const float speed = launch(lane(1.5f, 6.5f, 0.12f), 700).ball_speed;
    EXPECT_GT(speed, 2.3f);
    EXPECT_LT(speed, 3.0f);
}

TEST(Plunger, ComesToRestOnItsStop)
{
    const Table table = lane(1.5f, 6.5f, 0.12f);
    Playfield field(table, 1);
    run(field, 700, {.plunger = true});
    EXPECT_EQ(count(field.events(), EventKind::PlungerReleased), 0);
    ASSERT_TRUE(run_until(field, EventKind::PlungerReleased, 1));
    run(field, 1000);
    EXPECT_NEAR(field.state(1).travel, 0, 0.0002f);
    EXPECT_NEAR(field.state(1).speed, 0, 0.002f);
}

TEST(Plunger, ALaunchedBallIsReportedOnce)
{
    const Table table = lane(1.5f, 6.5f, 0.12f);
    Playfield field(table, 1);
    field.add_ball({1, 0.5237f});
    int launched = 0;
    for (int i = 0; i < 1500; ++i)
    {
        field.step({.plunger = i < 600});
        launched += count(field.events(), EventKind::Launched);
        // It is the column before the rod that counts, so push it sideways out of it.
        if (i == 800)
            field.scene().body(field.balls().front().state.body).set_velocity({1, 0});
    }
    EXPECT_EQ(launched, 1);
}

TEST(Plunger, AStickHoldsTheRodWhereItIs)
{
    const Table table = lane(1.5f, 6.5f, 0.12f);
    Playfield field(table, 1);
    for (const int rod : {255, 60, 128, 200, 20})
    {
        run(field, 400, {.rod = static_cast<std::uint8_t>(rod)});
        EXPECT_NEAR(field.state(1).travel, 0.05f * static_cast<float>(rod) / 255, 0.0005f) << rod;
        EXPECT_NEAR(field.state(1).speed, 0, 0.005f);
    }
    run(field, 400);
    EXPECT_NEAR(field.state(1).travel, 0, 0.0002f);
}

TEST(Plunger, AStickThatIsLetGoLaunchesAsTheKeyDoes)
{
    const Table table = lane(1.5f, 6.5f, 0.12f);
    const auto fastest = [&](const Buttons& buttons)
    {
        Playfield field(table, 1);
        field.add_ball({1, 0.5237f});
        run(field, 900, buttons);
        float speed = 0;
        for (int i = 0; i < 100; ++i)
        {
            field.step({});
            speed = std::max(speed, field.balls().front().state.velocity.y);
        }
        return speed;
    };
    const float key = fastest({.plunger = true});
    EXPECT_NEAR(fastest({.rod = 255}), key, 0.01f * key);
    EXPECT_LT(fastest({.rod = 128}), 0.6f * key);
}

} // namespace
} // namespace carom::pinball::test
