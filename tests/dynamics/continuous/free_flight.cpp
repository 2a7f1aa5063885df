// A body that flies through a whole step at once goes where sub-steps lead it; weak presses in flight are taken in few blows.

#include "dynamics/state/scene_data.h"
#include "support/test_scene.h"

#include <algorithm>
#include <cmath>

using namespace carom;
using namespace carom::test;

namespace {

// Boxes thrown past each other, each near others all the time; some meet in the end.
std::vector<BodyId> throw_boxes(Scene& scene)
{
    std::vector<BodyId> boxes;
    Random random(7);
    for (int i = 0; i < 8; ++i)
        boxes.push_back(add_dynamic(scene, {0.62 * (i % 4), 0.62 * (i / 4)}, box(0.2f, 0.2f),
                                    {.friction = 0.4f, .restitution = 0.5f}, random.vec(0.6), random.rangef(-2, 2))
                            .body);
    return boxes;
}

} // namespace

// Poses of sub-steps are recorded only where bodies go through them one by one.
TEST(FreeFlight, GoesThroughAWholeStepAsThroughItsSubsteps)
{
    SceneDef by_substeps = sleepless();
    by_substeps.record_substeps = true;
    Scene whole(sleepless());
    Scene parts(by_substeps);
    const std::vector<BodyId> a = throw_boxes(whole);
    const std::vector<BodyId> b = throw_boxes(parts);
    int impacts = 0;
    for (int i = 0; i < 60; ++i)
    {
        whole.step(1.0f / 60);
        parts.step(1.0f / 60);
        impacts += static_cast<int>(parts.impacts().size());
        ASSERT_EQ(whole.impacts().size(), parts.impacts().size()) << "step " << i;
        const double tolerance = impacts == 0 ? 1e-6 : 1e-4; // what an impact makes of a rounding
        for (std::size_t k = 0; k < a.size(); ++k)
        {
            const Body x = whole.body(a[k]);
            const Body y = parts.body(b[k]);
            EXPECT_NEAR(x.position().x, y.position().x, tolerance) << "step " << i << ", box " << k;
            EXPECT_NEAR(x.position().y, y.position().y, tolerance) << "step " << i << ", box " << k;
            EXPECT_NEAR(x.angle(), y.angle(), tolerance) << "step " << i << ", box " << k;
        }
    }
    EXPECT_GE(impacts, 3);
}

// Where they touch, each turns into the other: so slowly that blows come seldom. None may sink in, or gain from it.
TEST(FreeFlight, WhatPressesWeaklyNeitherSinksInNorGains)
{
    Scene scene(weightless());
    std::vector<BodyId> boxes;
    for (int i = 0; i < 3; ++i)
        boxes.push_back(add_dynamic(scene, {0.5 * i, 0.1 * (i % 2)}, box(0.25f, 0.25f), {.friction = 0.6f, .restitution = 0},
                                    {0.02f - 0.02f * static_cast<float>(i), 0}, 0.3f - 0.2f * static_cast<float>(i))
                            .body);
    const auto energy = [&]
    {
        double sum = 0;
        for (const BodyId id : boxes)
            sum += kinetic(scene, id);
        return sum;
    };
    const double start = energy();
    double last = start;
    float deepest = 0;
    for (int i = 0; i < 300; ++i)
    {
        scene.step(1.0f / 60);
        EXPECT_LE(energy(), last + 1e-5 * start) << "step " << i;
        last = energy();
        for (const ContactInfo& c : scene.contacts())
        {
            for (int p = 0; p < c.point_count; ++p)
                deepest = std::min(deepest, c.points[p].separation);
        }
    }
    EXPECT_LT(last, 0.9 * start);
    EXPECT_GT(deepest, -1e-3f);
}

// However many they are, and whoever else falls.
TEST(FreeFlight, WhatIsAloneFallsAsIfByItself)
{
    constexpr int count = 600;
    const auto throw_ball = [](Scene& scene, int i)
    {
        return add_dynamic(scene, {4.0 * (i % 30), 4.0 * (i / 30)}, Circle{.radius = 0.2f}, {},
                           {0.01f * static_cast<float>(i), 1.0f}, 0.1f * static_cast<float>(i % 7))
            .body;
    };
    Scene all(sleepless());
    std::vector<BodyId> balls;
    for (int i = 0; i < count; ++i)
        balls.push_back(throw_ball(all, i));
    steps(all, 20);
    EXPECT_EQ(all.report().islands, count);
    EXPECT_EQ(all.report().flight_bodies, count);
    for (const int i : {0, 1, 255, 256, 599})
    {
        Scene one(sleepless());
        const BodyId ball = throw_ball(one, i);
        steps(one, 20);
        EXPECT_EQ(all.body(balls[static_cast<std::size_t>(i)]).position(), one.body(ball).position()) << i;
        EXPECT_EQ(all.body(balls[static_cast<std::size_t>(i)]).angle(), one.body(ball).angle()) << i;
    }
}
