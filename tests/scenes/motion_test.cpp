// Things that move as told, things that are fast, piles.

#include "scene_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::scenes {
namespace {

TEST(KinematicBar, IsNeverPushedAndKeepsToItsTargets)
{
    SceneRun run("kinematic_bar");
    const auto moved = run.bodies_of(BodyType::Kinematic);
    for (int i = 0; i < 480; ++i)
    {
        run.steps(1);
        ASSERT_EQ(run.scene().body(moved[0]).angular_velocity(), 3.0f);
        ASSERT_EQ(run.scene().body(moved[0]).position(), (Position{-4, 4}));
        const float phase = static_cast<float>(i % 240) / 240;
        const float out = phase < 0.5f ? phase * 2 : 2 - phase * 2;
        ASSERT_NEAR(run.scene().body(moved[1]).position().x, 12.5 - 5.0 * static_cast<double>(out * out * (3 - 2 * out)), 1e-4)
            << i;
    }
}

void expect_inside(SceneRun& run, const Box& box)
{
    for (const BodyId id : run.dynamic())
    {
        const Position p = run.scene().body(id).position();
        ASSERT_TRUE(p.x > box.lower.x && p.x < box.upper.x && p.y > box.lower.y && p.y < box.upper.y)
            << p.x << ", " << p.y << " at " << run.scene().time() << " s";
    }
}

TEST(KinematicBar, NoBallIsPushedThroughFloorOrWall)
{
    SceneRun run("kinematic_bar");
    for (int i = 0; i < 900; ++i)
    {
        run.steps(1);
        ASSERT_NO_FATAL_FAILURE(expect_inside(run, {{-10, 0}, {10, 150}}));
    }
}

TEST(Bullet, NoneGetsOutAndNoneChangesItsSpeed)
{
    SceneRun run("bullet");
    double start = 0;
    for (const BodyId id : run.dynamic())
        start += static_cast<double>(run.scene().body(id).kinetic_energy());
    for (int i = 0; i < 300; ++i)
    {
        run.steps(1);
        ASSERT_NO_FATAL_FAILURE(expect_inside(run, {{-10, 0}, {10, 10}}));
    }
    double end = 0;
    for (const BodyId id : run.dynamic())
        end += static_cast<double>(run.scene().body(id).kinetic_energy());
    EXPECT_NEAR(end, start, 0.01 * start);
}

// The test above would miss this if nothing were fast: without continuous collision they do get out.
TEST(Bullet, GetOutWithoutContinuousCollision)
{
    SceneRun run("bullet", {.continuous = false});
    run.steps(300);
    const auto bodies = run.dynamic();
    EXPECT_TRUE(std::ranges::any_of(bodies,
                                    [&](BodyId id)
                                    {
                                        const Position p = run.scene().body(id).position();
                                        return p.x < -10.2 || p.x > 10.2 || p.y < -0.2 || p.y > 10.2;
                                    }));
}

TEST(MixedPile, ComesToRestInsideTheTrough)
{
    SceneRun run("mixed_pile");
    run.seconds(20);
    ASSERT_NO_FATAL_FAILURE(expect_inside(run, {{-6, 0}, {6, 22}}));
    // Balls and capsules may rock for long; nearly all of the pile sleeps or is slow.
    int fast = 0;
    for (const BodyId id : run.dynamic())
        fast += length(run.scene().body(id).velocity()) > 0.1f;
    EXPECT_LE(fast, 4);
}

TEST(Drum, KeepsEverythingInsideTheDrum)
{
    SceneRun run("drum");
    for (int i = 0; i < 900; ++i)
    {
        run.steps(1);
        for (const BodyId id : run.dynamic())
        {
            // Turned back with the drum, everything is within its walls.
            const Vec2 p = run.scene().body(run.bodies_of(BodyType::Kinematic)[0]).local_point(run.scene().body(id).position());
            ASSERT_LT(std::max(std::abs(p.x), std::abs(p.y)), 4.75f) << "step " << i;
        }
    }
    EXPECT_EQ(run.awake(), 225);
}

TEST(ManySizes, NothingSinksIntoTheFloorOrLeavesItsBay)
{
    SceneRun run("many_sizes");
    int small = 0;
    for (int i = 0; i < 600; ++i)
    {
        run.steps(1);
        for (const BodyId id : run.dynamic())
        {
            const ConstBody body = std::as_const(run.scene()).body(id);
            const Position p = body.position();
            const bool tiny = body.mass() < 1e-4f;
            small += tiny;
            ASSERT_GT(p.y, 0) << "step " << i << ", mass " << body.mass();
            ASSERT_GT(p.x, tiny ? 10.0 : -9.0) << "step " << i;
            ASSERT_LT(p.x, tiny ? 11.0 : 9.0) << "step " << i;
        }
    }
    EXPECT_EQ(small, 300 * 600);
}

TEST(Triggers, LiftBrakeAndBumpersDoTheirWork)
{
    SceneRun run("triggers");
    int enters = 0;
    int exits = 0;
    int kicks = 0;
    double highest = 0;
    for (int i = 0; i < 600; ++i)
    {
        run.steps(1);
        enters += static_cast<int>(run.scene().trigger_enters().size());
        exits += static_cast<int>(run.scene().trigger_exits().size());
        for (const ImpactEvent& e : run.scene().impacts())
            kicks += e.kick_speed > 0;
        if (i > 120)
            for (const BodyId id : run.dynamic())
                highest = std::max(highest, run.scene().body(id).position().y);
    }
    EXPECT_GT(enters, 10);
    EXPECT_LE(exits, enters);
    EXPECT_GT(kicks, 3);
    EXPECT_GT(highest, 6);
}

} // namespace
} // namespace carom::scenes
