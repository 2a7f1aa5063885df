// The reflexes of one flipper, with balls that a test puts in its way.

#include "pinball/autoplay/reflex.h"
#include "pinball/game/auto_plunger.h"

#include "bench_table.h"

#include <gtest/gtest.h>

namespace carom::pinball::test {
namespace {

const Flipper left_flipper{
    .pivot = {1, 1}, .length = 0.062f, .base_radius = 0.011f, .tip_radius = 0.0065f, .rest = radians(-31), .up = radians(16)};

/// Steps until the button goes down; -1 when it does not within half a second.
int press_step(FlipperReflex& reflex, Random& random, const BallState& ball)
{
    for (int i = 0; i < 500; ++i)
        if (reflex.step({ball}, random))
            return i;
    return -1;
}

BallState on_bat(float along, float gap, float slide, float rise)
{
    const Vec2 d = rotate(Rotation::from_angle(left_flipper.rest), {1, 0});
    const Vec2 n = perp(d);
    const float reach = 0.011f + 0.0135f - 0.0045f * along / 0.062f;
    return {.position = Position(left_flipper.pivot + along * d + (reach + gap) * n), .velocity = slide * d + rise * n};
}

TEST(Reflex, FlipsAtWhatIsAboutToArrive)
{
    const Table table = bare_table();
    Random random(1);
    FlipperReflex reflex(table, left_flipper, random);
    const int press = press_step(reflex, random, on_bat(0.045f, 0.02f, 0, -1));
    EXPECT_GE(press, 0);
    EXPECT_LE(press, 13);
}

TEST(Reflex, HoldsForAWhileAndThenRests)
{
    const Table table = bare_table();
    Random random(1);
    FlipperReflex reflex(table, left_flipper, random);
    const BallState ball = on_bat(0.045f, 0.02f, 0, -1);
    ASSERT_GE(press_step(reflex, random, ball), 0);
    int held = 1;
    while (reflex.step({ball}, random))
        ++held;
    EXPECT_EQ(held, 130);
    int rested = 1;
    while (!reflex.step({ball}, random))
        ++rested;
    EXPECT_GE(rested, 120);
}

TEST(Reflex, LeavesAloneWhatGoesElsewhere)
{
    const Table table = bare_table();
    Random random(1);
    FlipperReflex reflex(table, left_flipper, random);
    EXPECT_EQ(press_step(reflex, random, on_bat(0.045f, 0.02f, 0, 1)), -1) << "flies away";
    EXPECT_EQ(press_step(reflex, random, on_bat(0.15f, 0.02f, 0, -1)), -1) << "misses the bat";
    EXPECT_EQ(press_step(reflex, random, on_bat(0.045f, 0.2f, 0, -1)), -1) << "is far";
    EXPECT_EQ(press_step(reflex, random, on_bat(0.045f, -0.06f, 0, -1)), -1) << "is below";
    BallState captive = on_bat(0.045f, 0.02f, 0, -1);
    captive.captive = true;
    EXPECT_EQ(press_step(reflex, random, captive), -1);
}

TEST(Reflex, StrikesARollingBallPastItsAim)
{
    const Table table = bare_table();
    Random random(1);
    FlipperReflex reflex(table, left_flipper, random);
    EXPECT_EQ(press_step(reflex, random, on_bat(0.02f, 0, 0.2f, 0)), -1) << "before any aim";
    EXPECT_GE(press_step(reflex, random, on_bat(0.06f, 0, 0.2f, 0)), 0) << "past every aim";
}

TEST(AutoPlunger, LaunchesAsManyBallsAsItWasToldOneAfterTheOther)
{
    AutoPlunger plunger;
    plunger.launch();
    plunger.launch();
    int releases = 0;
    bool held = false;
    for (int i = 0; i < 10'000; ++i)
    {
        const bool holds = plunger.step(true, 600);
        const bool released = held && !holds;
        releases += released ? 1 : 0;
        held = holds;
        // The first pull is too weak, the ball falls back.
        if (released && releases > 1)
            plunger.launched();
    }
    EXPECT_EQ(releases, 3);
}

TEST(AutoPlunger, WaitsForABallThatLiesStill)
{
    AutoPlunger plunger;
    plunger.launch();
    for (int i = 0; i < 5000; ++i)
        ASSERT_FALSE(plunger.step(i % 100 != 0, 600)) << "it comes and goes";
    bool pulled = false;
    for (int i = 0; i < 500; ++i)
        pulled = pulled || plunger.step(true, 600);
    EXPECT_TRUE(pulled);
}

TEST(AutoPlunger, KeepsPullingWhenTheBallLeavesTheSwitchWithTheRod)
{
    AutoPlunger plunger;
    plunger.launch();
    int held = 0;
    for (int i = 0; i < 2000; ++i)
        held += plunger.step(i < 350, 600) ? 1 : 0;
    EXPECT_EQ(held, 600);
}

} // namespace
} // namespace carom::pinball::test
