// Islands so large that they are cut into parts of the plane, see dynamics/unit_bins.h.

#include "support/test_scene.h"
#include "support/threads.h"

#include "dynamics/state/scene_data.h"
#include "dynamics/step_context.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

using namespace carom;
using namespace carom::test;

namespace {

constexpr int balls_across = 300;
constexpr int balls_high = 8; // of balls 0.2 m wide
constexpr float radius = 0.1f;

// Balls a hexagon's distance apart, the lowest of them set into a floor: their centers at that height.
Scene piled_balls(const TaskHooks& tasks, int across, int high, double lowest)
{
    SceneDef def = sleepless();
    def.tasks = tasks;
    Scene scene(def);
    add_static(scene, HalfSpace{}, {.friction = 0.6f});
    for (int i = 0; i < across * high; ++i)
    {
        const int row = i / across;
        add_dynamic(scene, {0.2 * (i % across) + 0.1 * (row % 2), lowest + 0.17 * row}, Circle{.radius = radius},
                    {.friction = 0.6f});
    }
    return scene;
}

Scene sunk_balls(const TaskHooks& tasks) { return piled_balls(tasks, balls_across, balls_high, 0.01); }

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

// The number of moving bodies in the plane cell that has most of them.
std::size_t fullest_cell(Scene& scene)
{
    const internal::SceneState& state = scene.data().state;
    std::vector<std::size_t> counts(internal::plane_cells);
    for (const std::int32_t body : state.awake_bodies)
        ++counts[state.bodies[body].plane_cell];
    return *std::ranges::max_element(counts);
}

// Groups of eight rows of each part of the largest island.
std::vector<std::int32_t> groups_of_parts(Scene& scene)
{
    const internal::Scratch& scratch = scene.data().scratch;
    const internal::Island& island = *std::ranges::max_element(scratch.solver.islands, {}, &internal::Island::edge_count);
    std::vector<std::int32_t> groups;
    for (int part = 0; part < island.partitions; ++part)
    {
        const auto starts = scratch.solver.bucket_starts.begin() + island.first_bucket + part * island.bucket_count;
        groups.push_back(starts[island.bucket_count] - starts[0]);
    }
    return groups;
}

// Impulses along y by body slot, as the contacts of the last step report them.
std::vector<double> upward_impulses(Scene& scene)
{
    std::vector<double> sums(static_cast<std::size_t>(scene.data().state.bodies.capacity()));
    for (const ContactInfo& contact : scene.contacts())
    {
        double impulse = 0;
        for (const ContactInfo::Point& point : std::span(contact.points).first(static_cast<std::size_t>(contact.point_count)))
            impulse += static_cast<double>(point.normal_impulse * contact.normal.y + point.friction_impulse * contact.normal.x);
        sums[scene.shape(contact.shape_a).body().slot - 1] -= impulse;
        sums[scene.shape(contact.shape_b).body().slot - 1] += impulse;
    }
    return sums;
}

} // namespace

// Two balls to a pile's one lie in a single row beside it, and have a third of its rows.
TEST(DynamicsLargeIsland, PartsHaveAboutAsMuchWorkEach)
{
    constexpr int in_row = 4000;
    Scene scene = piled_balls({}, 80, 25, 0.98 * static_cast<double>(radius));
    for (int i = 0; i < in_row; ++i)
        add_dynamic(scene, {-0.199 * (i + 1), 0.98 * static_cast<double>(radius)}, Circle{.radius = radius}, {.friction = 0.6f});
    for (int i = 0; i < 3; ++i)
        scene.step(1.0f / 60);
    const std::vector<std::int32_t> groups = groups_of_parts(scene);
    ASSERT_GE(groups.size(), 4u);
    EXPECT_LT(std::ranges::max(groups), 1.3 * std::ranges::min(groups));
}

// A wall that wakes from one end to the other, between the steps in which bodies are parted anyway.
TEST(DynamicsLargeIsland, WhatWakesGetsCellsOfItsOwn)
{
    Scene scene;
    for (int i = 0; i < 4000; ++i)
    {
        const BodyId brick = add_dynamic(scene, {0.4 * (i / 40), 0.4 * (i % 40)}, box(0.2f, 0.2f)).body;
        scene.body(brick).set_awake(false);
    }
    const BodyId ram = add_dynamic(scene, {-3, 8}, box(2, 2), {.density = 8}, {60, 0}).body;
    for (int i = 0; i < 20; ++i)
    {
        scene.step(1.0f / 60);
        const std::size_t awake = scene.data().state.awake_bodies.size();
        if (scene.contacts().size() > 2000)
        {
            EXPECT_LE(fullest_cell(scene), awake / 4 + 1) << "step " << i;
        }
    }
    EXPECT_GT(scene.body(ram).position().x, 2);
    EXPECT_GT(scene.data().state.awake_bodies.size(), 2000u);
}

TEST(DynamicsLargeIsland, WhatIsSetTooDeepIntoTheFloorComesOutAndGoesNoDeeper)
{
    Scene scene = sunk_balls({});
    Threads three(3);
    Scene on_three = sunk_balls(three.hooks());
    float before = deepest(scene);
    for (int i = 0; i < 40; ++i)
    {
        scene.step(1.0f / 60);
        on_three.step(1.0f / 60);
        const float depth = deepest(scene);
        ASSERT_LT(depth, std::max(0.51f * radius, before)) << "step " << i;
        before = depth;
        ASSERT_EQ(on_three.state_hash(), scene.state_hash()) << "step " << i;
    }
    EXPECT_LT(before, 0.1f * radius);
}

// In such an island parts relax before what flies in it flies. They are parts of the plane from the second step on.
TEST(DynamicsLargeIsland, WhatFliesIntoNinetyThousandBallsIsTheSameOnThreeThreads)
{
    Threads three(3);
    std::vector<Scene> scenes;
    for (const TaskHooks& tasks : {TaskHooks{}, three.hooks()})
    {
        scenes.push_back(piled_balls(tasks, 450, 200, 0.98 * static_cast<double>(radius)));
        scenes.back().step(1.0f / 60);
        for (int i = 0; i < 20; ++i)
            add_dynamic(scenes.back(), {4.0 * i + 2, 34.5}, Circle{.radius = radius}, {}, {0, -30});
    }
    for (int i = 0; i < 3; ++i)
    {
        for (Scene& scene : scenes)
            scene.step(1.0f / 60);
        ASSERT_EQ(scenes[1].state_hash(), scenes[0].state_hash()) << "step " << i;
        const internal::Scratch& scratch = scenes[0].data().scratch;
        ASSERT_TRUE(std::ranges::any_of(scratch.solver.islands, [](const internal::Island& island)
                                        { return internal::exceeds_shared_cache(island.partitions); }));
        EXPECT_GT(std::ranges::count(scratch.solver.partition_of, 31), 1000) << "the last part";
        if (i == 0)
        {
            EXPECT_GE(scenes[0].report().flight_impacts, 20);
        }
    }
    const std::vector<BodyId> bodies = scenes[0].bodies();
    for (std::size_t i = bodies.size() - 20; i < bodies.size(); ++i)
        EXPECT_GT(scenes[0].body(bodies[i]).position().y, 33.93) << "it has sunk in to its own center or deeper";
}

// m dv = impulses + m g dt, for all but the few that something has flown into.
TEST(DynamicsLargeIsland, SumsOfImpulsesAreWhatNinetyThousandBallsGot)
{
    Scene scene = piled_balls({}, 450, 200, 0.98 * static_cast<double>(radius));
    scene.step(1.0f / 60);
    const std::vector<BodyId> bodies = scene.bodies();
    for (int i = 0; i < 20; ++i)
        add_dynamic(scene, {4.0 * i + 2, 34.5}, Circle{.radius = radius}, {}, {0, -30});
    std::vector<float> before;
    for (const BodyId body : bodies)
        before.push_back(scene.body(body).velocity().y);
    scene.step(1.0f / 60);
    ASSERT_GE(scene.report().flight_impacts, 20);
    const std::vector<double> impulses = upward_impulses(scene);
    int wrong = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
    {
        const Body body = scene.body(bodies[i]);
        if (body.type() != BodyType::Dynamic)
            continue;
        const double given = static_cast<double>(body.velocity().y - before[i]) + 9.81 / 60;
        wrong += std::fabs(impulses[bodies[i].slot - 1] / static_cast<double>(body.mass()) - given) > 0.05 * 9.81 / 60 ? 1 : 0;
    }
    EXPECT_LT(wrong, 300);
}
