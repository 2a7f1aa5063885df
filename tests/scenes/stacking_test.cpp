// Stacks and pyramids stand, do not sink, do not creep, and fall asleep.

#include "scene_run.h"

#include <cmath>

namespace carom::scenes {
namespace {

struct Drift
{
    double x = 0;
    double y = 0;
    float angle = 0;
};

// How far the body that moved most is from where it was built.
Drift worst_drift(SceneRun& run, const std::vector<Position>& start)
{
    Drift worst;
    const auto bodies = run.dynamic();
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        const auto body = run.scene().body(bodies[i]);
        worst.x = std::max(worst.x, std::abs(body.position().x - start[i].x));
        worst.y = std::max(worst.y, std::abs(body.position().y - start[i].y));
        worst.angle = std::max(worst.angle, std::abs(body.angle()));
    }
    return worst;
}

std::vector<Position> positions(SceneRun& run)
{
    std::vector<Position> list;
    for (const BodyId id : run.dynamic())
        list.push_back(run.scene().body(id).position());
    return list;
}

TEST(Stack, StandsForTenSecondsWithoutSleep)
{
    SceneRun run("stack", {.sleeping = false});
    const auto start = positions(run);
    run.seconds(10);
    const Drift drift = worst_drift(run, start);
    EXPECT_LT(drift.x, 0.01);
    EXPECT_LT(drift.y, 0.05); // ten contacts, each up to half a centimetre deep
    EXPECT_LT(drift.angle, 0.01f);
}

TEST(Stack, FallsAsleepAndWakesWhenHit)
{
    SceneRun run("stack");
    run.seconds(4);
    EXPECT_EQ(run.awake(), 0);
    const auto bodies = run.dynamic();
    run.scene().body(bodies.back()).apply_impulse({0, -0.5f});
    run.steps(1);
    EXPECT_EQ(run.awake(), 10);
}

TEST(TallStack, StandsForTenSecondsWithoutSleep)
{
    SceneRun run("tall_stack", {.sleeping = false});
    const auto start = positions(run);
    run.seconds(10);
    const Drift drift = worst_drift(run, start);
    EXPECT_LT(drift.x, 0.05);
    EXPECT_LT(drift.y, 0.1);
    EXPECT_LT(drift.angle, 0.01f);
}

class Pyramid : public testing::TestWithParam<const char*>
{};

TEST_P(Pyramid, StandsAndSleeps)
{
    SceneRun run(GetParam());
    const auto start = positions(run);
    run.seconds(10);
    const Drift drift = worst_drift(run, start);
    EXPECT_LT(drift.x, 0.05);
    EXPECT_LT(drift.y, 0.1);
    EXPECT_LT(drift.angle, 0.02f);
    EXPECT_EQ(run.awake(), 0);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Pyramid, testing::Values("small_pyramid", "pyramid"));

TEST(PyramidSleep, CostsNothingAndKeepsItsHash)
{
    SceneRun run("small_pyramid");
    run.seconds(10);
    ASSERT_EQ(run.awake(), 0);
    EXPECT_EQ(run.scene().report().awake_bodies, 0);
    const auto before = positions(run);
    run.seconds(1);
    EXPECT_EQ(positions(run), before);
}

} // namespace
} // namespace carom::scenes
