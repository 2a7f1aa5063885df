// Units so large that they are cut into parts of the plane, see dynamics/unit_bins.h.

#include "support/test_scene.h"
#include "support/threads.h"

#include <algorithm>

using namespace carom;
using namespace carom::test;

namespace {

constexpr int balls_across = 300;
constexpr int balls_high = 8; // of balls 0.2 m wide
constexpr float radius = 0.1f;

// Balls a hexagon's distance apart, the lowest of them set far too deep into a floor.
Scene sunk_balls(const TaskHooks& tasks)
{
    SceneDef def = sleepless();
    def.tasks = tasks;
    Scene scene(def);
    add_static(scene, HalfSpace{}, {.friction = 0.6f});
    for (int i = 0; i < balls_across * balls_high; ++i)
    {
        const int row = i / balls_across;
        add_dynamic(scene, {0.2 * (i % balls_across) + 0.1 * (row % 2), 0.01 + 0.17 * row}, Circle{.radius = radius},
                    {.friction = 0.6f});
    }
    return scene;
}

float deepest(const Scene& scene)
{
    float depth = 0;
    for (const BodyId body : scene.bodies())
    {
        if (scene.body(body).type() == BodyType::Dynamic)
            depth = std::max(depth, radius - static_cast<float>(scene.body(body).position().y));
    }
    return depth;
}

} // namespace

TEST(DynamicsLargeUnit, WhatIsSetTooDeepIntoTheFloorComesOutToHalfOfItsRadiusAtOnce)
{
    Scene scene = sunk_balls({});
    Threads three(3);
    Scene on_three = sunk_balls(three.hooks());
    for (int i = 0; i < 40; ++i)
    {
        scene.step(1.0f / 60);
        on_three.step(1.0f / 60);
        ASSERT_LT(deepest(scene), 0.51f * radius) << "step " << i;
        ASSERT_EQ(on_three.state_hash(), scene.state_hash()) << "step " << i;
    }
}
