// Nudges: the cabinet moves, the ball keeps its inertia, and the bob tells when it was too much.

#include "bench_table.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace carom::pinball::test {
namespace {

constexpr Buttons from_left{.nudge_left = true};
constexpr Buttons from_right{.nudge_right = true};
constexpr Buttons from_front{.nudge_up = true};

/// Taps a nudge for a step.
void tap(Playfield& field, const Buttons& nudge)
{
    field.step(nudge);
    field.step({});
}

TEST(Nudge, ABallWithoutFrictionStaysWhereItIsInTheRoom)
{
    for (const Buttons& nudge : {from_left, from_right, from_front})
    {
        const Table table = bare_table(0, 0);
        Playfield field(table, 1);
        field.add_ball({1, 1});
        field.step(nudge);
        float farthest = 0;
        for (int i = 0; i < 1000; ++i)
        {
            field.step({});
            const Vec2 moved = field.balls().front().state.position - Position{1, 1};
            const Vec2 cabinet = field.cabinet().offset();
            EXPECT_NEAR(moved.x, -cabinet.x, 2e-5f) << i;
            EXPECT_NEAR(moved.y, -cabinet.y, 2e-5f) << i;
            farthest = std::max(farthest, length(cabinet));
        }
        EXPECT_GT(farthest, 0.0025f);
        EXPECT_LT(farthest, 0.006f);
    }
}

TEST(Nudge, TheCabinetSwingsAsItsLegsLetItAndComesToRest)
{
    const Table table = bare_table();
    Playfield field(table, 1);
    tap(field, from_left);
    run(field, 30);
    std::vector<int> crossings;
    float last = field.cabinet().offset().x;
    EXPECT_GT(last, 0) << "a slap on the left side moves it to the right";
    for (int i = 0; i < 600; ++i)
    {
        field.step({});
        const float now = field.cabinet().offset().x;
        if (last < 0 && now >= 0)
            crossings.push_back(i);
        last = now;
    }
    ASSERT_GE(crossings.size(), 5u);
    EXPECT_NEAR(crossings[4] - crossings[0], 4 * 1000 / 9.3, 6);
    run(field, 6000);
    EXPECT_EQ(field.cabinet().offset(), Vec2{});
    EXPECT_EQ(field.scene().gravity(), Playfield(table, 1).scene().gravity());
}

TEST(Nudge, AFinerStepComesNearer)
{
    const auto moved = [](float step)
    {
        Table table = bare_table(6.5f, 0.12f);
        table.physics.step = step;
        add(table, wall({0.5f, 0}, {0.5f, 2}));
        Playfield field(table, 1);
        shoot(field, {0.5f + 0.0135f + 0.001f, 1}, {0, -0.5f}, true);
        field.step(from_left);
        run(field, static_cast<int>(std::lround(0.3f / step)) - 1);
        return field.balls().front().state.position;
    };
    const Position truth = moved(0.00025f);
    EXPECT_LT(length(moved(0.001f) - truth), 1e-4f);
    EXPECT_LT(length(moved(0.002f) - truth), 0.5f * length(moved(0.008f) - truth));
}

TEST(Nudge, AWallThatComesThrowsTheBall)
{
    Table table = bare_table(6.5f, 0.12f);
    add(table, wall({0.5f, 0}, {0.5f, 2}));
    const auto fastest = [&](const Buttons& nudge)
    {
        Playfield field(table, 1);
        shoot(field, {0.5f + 0.0135f, 1}, {0, -0.3f}, true);
        field.step(nudge);
        float speed = 0;
        for (int i = 0; i < 40; ++i)
        {
            field.step({});
            speed = std::max(speed, field.balls().front().state.velocity.x);
        }
        return speed;
    };
    EXPECT_GT(fastest(from_left), 0.1f) << "seen from the cabinet";
    EXPECT_LT(fastest({}), 0.01f);
}

TEST(Nudge, AHandMustBeDrawnBackFirst)
{
    const Table table = bare_table();
    Playfield field(table, 1);
    int pushes = 0;
    for (int i = 0; i < 1000; ++i)
    {
        field.step({.nudge_left = i % 20 < 10});
        pushes += count(field.events(), EventKind::Nudged);
    }
    EXPECT_GE(pushes, 5);
    EXPECT_LE(pushes, 7);
}

TEST(Nudge, AHandOnTheButtonPushesOnce)
{
    const Table table = bare_table();
    Playfield tapped(table, 1);
    Playfield held(table, 1);
    tap(tapped, from_front);
    run(tapped, 500);
    run(held, 502, from_front);
    EXPECT_EQ(tapped.cabinet().offset(), held.cabinet().offset());
}

int touches(const std::vector<Buttons>& nudges, int pause)
{
    const Table table = bare_table();
    Playfield field(table, 1);
    int found = 0;
    const auto step = [&](const Buttons& buttons)
    {
        field.step(buttons);
        found += count(field.events(), EventKind::BobTouched);
    };
    for (const Buttons& nudge : nudges)
    {
        step(nudge);
        for (int i = 0; i < pause; ++i)
            step({});
    }
    for (int i = 0; i < 3000; ++i)
        step({});
    return found;
}

TEST(TiltBob, ASingleNudgeIsFreeAndAStormOfThemIsNot)
{
    for (const Buttons& nudge : {from_left, from_right, from_front})
        EXPECT_EQ(touches({nudge}, 10), 0);
    EXPECT_EQ(touches({from_left, from_left, from_left}, 2000), 0) << "with time between them";
    EXPECT_EQ(touches({from_left, from_right, from_front, from_left, from_right, from_front}, 700), 0) << "a good player's";
    EXPECT_GT(touches({from_front, from_front, from_front, from_front}, 175), 0) << "in time with its swings";
    EXPECT_GT(touches({from_left, from_left, from_left, from_left, from_left}, 214), 0) << "in time with its swings";
}

TEST(Scatter, NoTwoPlungesAreTheSameAndNoneIsFarOff)
{
    Table table = bare_table();
    add(table, Plunger{.pos = {1, 0.5f},
                       .half = {0.01f, 0.01f},
                       .axis = {0, 1},
                       .stroke = 0.05f,
                       .mass = 0.15f,
                       .k = 620,
                       .c = 0.6f,
                       .preload = 2,
                       .pull_speed = 0.09f,
                       .lane = none});
    const auto speeds = [&](float scatter, std::uint64_t seed)
    {
        table.physics.scatter = scatter;
        std::vector<float> all;
        Playfield field(table, seed);
        for (int i = 0; i < 10; ++i)
        {
            field.add_ball({1, 0.5237f});
            run(field, 700, {.plunger = true});
            float fastest = 0;
            for (int k = 0; k < 60; ++k)
            {
                field.step({});
                fastest = std::max(fastest, field.balls().back().state.velocity.y);
            }
            all.push_back(fastest);
            field.take_lost_balls();
            run(field, 400);
        }
        return all;
    };
    const std::vector<float> steady = speeds(0, 1);
    for (const float speed : speeds(0.01f, 1))
        EXPECT_NEAR(speed, steady[0], 0.012f * steady[0]);
    for (const float speed : steady)
        EXPECT_NEAR(speed, steady[0], 0.003f * steady[0]);
    const std::vector<float> scattered = speeds(0.01f, 1);
    EXPECT_EQ(std::set<float>(scattered.begin(), scattered.end()).size(), scattered.size());
    EXPECT_EQ(scattered, speeds(0.01f, 1)) << "a seed is a seed";
    EXPECT_NE(scattered, speeds(0.01f, 2));
}

TEST(Scatter, ABumperKicksABitDifferentlyEachTime)
{
    Table table = bare_table(0, 0);
    table.physics.scatter = 0.02f;
    add(table, Bumper{.pos = {1, 1}, .radius = 0.03f, .kick_speed = 1, .threshold = 0.05f, .cooldown = 0});
    Playfield field(table, 3);
    std::set<float> kicks;
    for (int i = 0; i < 8; ++i)
    {
        shoot(field, {1, 1.06f}, {0, -0.5f});
        ASSERT_TRUE(run_until(field, EventKind::Fired, 100));
        for (const GameEvent& event : field.events())
            if (event.kind == EventKind::Fired)
            {
                EXPECT_NEAR(event.speed, 1, 0.021f);
                kicks.insert(event.speed);
            }
        field.take_lost_balls();
    }
    EXPECT_EQ(kicks.size(), 8u);
}

} // namespace
} // namespace carom::pinball::test
