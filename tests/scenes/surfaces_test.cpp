// Slopes, one-way floors, the belt, arcs.

#include "scene_run.h"

#include <cmath>

namespace carom::scenes {
namespace {

constexpr double degree = 3.14159265358979 / 180;

TEST(Slopes, FrictionDecidesWhoSlides)
{
    SceneRun run("slopes");
    const auto bodies = run.dynamic();
    std::vector<Position> start;
    for (int i = 0; i < 5; ++i)
        start.push_back(run.scene().body(bodies[static_cast<std::size_t>(i)]).position());
    run.seconds(1);
    // tan 20° = 0.364: friction 0.05 and 0.2 slide, 0.45 and more hold.
    for (std::size_t i = 0; i < 5; ++i)
    {
        const double moved = length(run.scene().body(bodies[i]).position() - start[i]);
        EXPECT_TRUE(i < 2 ? moved > 0.3 : moved < 0.02) << i << " moved by " << moved;
    }
}

TEST(Slopes, ASlidingBoxAcceleratesAsItsFrictionSays)
{
    SceneRun run("slopes");
    const BodyId box = run.dynamic()[1];
    run.seconds(0.1);
    const double before = length(run.scene().body(box).velocity());
    run.seconds(0.5);
    const double after = length(run.scene().body(box).velocity());
    EXPECT_NEAR((after - before) / 0.5, 9.81 * (std::sin(20 * degree) - 0.2 * std::cos(20 * degree)), 0.06);
}

TEST(Slopes, AWheelRollsWithTwoThirdsAndIceSlidesWithAll)
{
    SceneRun run("slopes");
    const BodyId wheel = run.dynamic()[5];
    const BodyId stiff_wheel = run.dynamic()[6];
    const BodyId ice = run.dynamic()[7];
    run.seconds(0.1);
    const auto speed = [&](BodyId id) { return static_cast<double>(length(run.scene().body(id).velocity())); };
    const double wheel_before = speed(wheel);
    const double stiff_before = speed(stiff_wheel);
    const double ice_before = speed(ice);
    run.seconds(0.6);
    const double g = 9.81 * std::sin(20 * degree);
    EXPECT_NEAR((speed(wheel) - wheel_before) / 0.6, g * 2 / 3, 0.05);
    EXPECT_NEAR((speed(ice) - ice_before) / 0.6, g, 0.05);
    EXPECT_LT(speed(stiff_wheel) - stiff_before, 0.9 * (speed(wheel) - wheel_before));
    // Rolling: the speed at the rim is the speed of the centre.
    EXPECT_NEAR(std::abs(run.scene().body(wheel).angular_velocity()) * 0.3f, static_cast<float>(speed(wheel)), 0.02f);
}

TEST(OneWay, BallsPassFromBelowAndRestOnTop)
{
    SceneRun run("one_way_and_conveyor");
    const auto bodies = run.dynamic();
    run.seconds(6);
    // Thrown at 7.5, 10 and 12.5 m/s from 0.4 m: they rise by v²/2g = 2.87, 5.1 and 7.96 m, through one, two (4.05 + 0.4
    // is below 5.5) and three floors, and come to rest on the highest they got wholly through.
    const double floors[] = {2.05, 4.05, 6.05};
    for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(run.scene().body(bodies[i]).position().y, floors[i] + 0.4, 0.02) << i;
}

TEST(OneWay, PassingLeavesTheSpeedAlone)
{
    SceneRun run("one_way_and_conveyor");
    const BodyId ball = run.dynamic()[2];
    run.steps(30);
    const double t = run.scene().time();
    EXPECT_NEAR(run.scene().body(ball).velocity().y, 12.5 - 9.81 * t, 0.02);
    EXPECT_GT(run.scene().body(ball).position().y, 4.5);
}

TEST(Conveyor, CarriesBoxesAtItsSpeedIntoTheBin)
{
    SceneRun run("one_way_and_conveyor");
    const auto bodies = run.dynamic();
    run.seconds(1);
    EXPECT_NEAR(run.scene().body(bodies[3]).velocity().x, 2, 0.05);
    run.seconds(9);
    for (std::size_t i = 3; i < 7; ++i)
    {
        const Position p = run.scene().body(bodies[i]).position();
        EXPECT_GT(p.x, 6.2) << i;
        EXPECT_LT(p.x, 10) << i;
        EXPECT_LT(p.y, 2.8) << i;
    }
}

double energy(SceneRun& run, BodyId id)
{
    const auto body = run.scene().body(id);
    return static_cast<double>(body.kinetic_energy()) + static_cast<double>(body.mass()) * 9.81 * body.position().y;
}

TEST(ArcLoop, TheBallGoesRoundTheLoopAndKeepsToIt)
{
    SceneRun run("arc_loop");
    const BodyId ball = run.dynamic()[0];
    double turned = 0;
    Vec2 before = run.scene().body(ball).position() - Position{-7, 3};
    for (int i = 0; i < 960; ++i)
    {
        run.steps(1);
        const Vec2 now = run.scene().body(ball).position() - Position{-7, 3};
        ASSERT_NEAR(length(now), 2.7f, 0.01f) << "step " << i;
        turned += static_cast<double>(std::atan2(cross(before, now), dot(before, now)));
        before = now;
    }
    EXPECT_GT(turned, 2 * 360 * degree);
}

TEST(ArcLoop, NoSeamIsFeltAndNoEnergyIsLost)
{
    for (const std::size_t which : {0u, 2u})
    {
        SceneRun run("arc_loop");
        const BodyId ball = run.dynamic()[which];
        run.seconds(0.25);
        const double start = energy(run, ball);
        for (int i = 0; i < 960; ++i)
        {
            run.steps(1);
            for (const ImpactEvent& e : run.scene().impacts())
                EXPECT_FALSE(e.body_a == ball || e.body_b == ball)
                    << which << " approach speed " << e.approach_speed << " step " << i;
        }
        EXPECT_NEAR(energy(run, ball), start, 1e-3 * start) << which;
    }
}

TEST(ArcLoop, TheHalfPipeGivesTheBallBackToItsHeight)
{
    SceneRun run("arc_loop");
    const BodyId ball = run.dynamic()[1];
    double right = -1e9;
    double left = -1e9;
    for (int i = 0; i < 2400; ++i)
    {
        run.steps(1);
        const Position p = run.scene().body(ball).position();
        ASSERT_GT(p.x, -2);
        ASSERT_LT(p.x, 5);
        if (p.x > 3)
            right = std::max(right, p.y);
        if (p.x < 0 && i > 480)
            left = std::max(left, p.y);
    }
    // Not to 4.5: the ball drops without spin, and what it spends on getting to roll is lost once.
    EXPECT_GT(right, 2);
    EXPECT_LT(right, 4.5);
    EXPECT_GT(left, 1);
}

} // namespace
} // namespace carom::scenes
