// All state is copied, stepped, restored and stepped again: the same hashes. The same scene twice, on any threads: the same hashes.

#include "support/effort.h"
#include "support/test_scene.h"
#include "support/threads.h"

#include "dynamics/state/scene_data.h"
#include "scenes/scenes.h"

#include <atomic>
#include <thread>

using namespace carom;
using namespace carom::test;

namespace {

std::vector<std::uint64_t> run(scenes::BuiltScene& built, float h, int count)
{
    std::vector<std::uint64_t> hashes;
    for (int i = 0; i < count; ++i)
    {
        built.step(h);
        hashes.push_back(built.scene.state_hash());
    }
    return hashes;
}

// A pool of threads that takes tasks in whatever order they come.
void run_on_threads(void*, int count, void (*task)(void*, int), void* context)
{
    std::atomic<int> next{0};
    const auto work = [&]
    {
        for (int i = next++; i < count; i = next++)
            task(context, i);
    };
    std::thread second(work);
    std::thread third(work);
    work();
    second.join();
    third.join();
}

} // namespace

TEST(DeterminismRestore, EverySceneContinuesFromACopyOfItsState)
{
    for (const scenes::SceneEntry& entry : scenes::small_scenes())
        for (const int when : {1, 40, 150})
        {
            SCOPED_TRACE(std::string(entry.name) + " at step " + std::to_string(when));
            scenes::BuiltScene built = entry.create({});
            if (built.before_step)
                continue; // driven from outside by a function that may remember
            for (int i = 0; i < when; ++i)
                built.step(entry.h);
            const internal::SceneState saved = built.scene.data().state;
            const std::uint64_t hash = built.scene.state_hash();
            const std::vector<std::uint64_t> first = run(built, entry.h, 40);
            built.scene.data().state = saved;
            EXPECT_EQ(built.scene.state_hash(), hash);
            EXPECT_EQ(run(built, entry.h, 40), first);
        }
}

TEST(DeterminismRestore, AlsoAfterManyMoreSteps)
{
    const scenes::SceneEntry& entry = scenes::all_scenes()[0];
    scenes::BuiltScene built = entry.create({});
    for (int i = 0; i < 20; ++i)
        built.step(entry.h);
    const internal::SceneState saved = built.scene.data().state;
    const std::vector<std::uint64_t> first = run(built, entry.h, 30);
    for (int i = 0; i < 400; ++i)
        built.step(entry.h); // everything sleeps by now
    built.scene.data().state = saved;
    EXPECT_EQ(run(built, entry.h, 30), first);
}

TEST(DeterminismTwice, EverySceneGivesTheSameHashesTwice)
{
    for (const scenes::SceneEntry& entry : scenes::small_scenes())
    {
        SCOPED_TRACE(entry.name);
        scenes::BuiltScene a = entry.create({});
        scenes::BuiltScene b = entry.create({});
        EXPECT_EQ(a.scene.state_hash(), b.scene.state_hash());
        EXPECT_EQ(run(a, entry.h, 120), run(b, entry.h, 120));
    }
}

TEST(DeterminismThreads, HooksChangeNothing)
{
    constexpr int count = slow_build ? 15 : 60;
    for (const scenes::SceneEntry& entry : scenes::small_scenes())
    {
        SCOPED_TRACE(entry.name);
        SceneDef threaded;
        threaded.tasks = {.worker_count = 3, .run = run_on_threads};
        SceneDef backwards;
        backwards.tasks = {.worker_count = 2, .run = run_backwards};
        scenes::BuiltScene serial = entry.create({});
        scenes::BuiltScene parallel = entry.create(threaded);
        scenes::BuiltScene reversed = entry.create(backwards);
        const std::vector<std::uint64_t> want = run(serial, entry.h, count);
        EXPECT_EQ(run(parallel, entry.h, count), want);
        EXPECT_EQ(run(reversed, entry.h, count), want);
    }
}

// Large enough for several tasks, with islands that merge and part.
TEST(DeterminismThreads, AThousandBodiesInManyIslands)
{
    const auto hashes = [](TaskHooks tasks)
    {
        SceneDef def;
        def.tasks = tasks;
        Scene scene(def);
        Random random(21);
        for (int i = 0; i < 40; ++i)
            add_static(scene, box(2, 0.5f), {.restitution = 0.3f}, {5.0 * i, -0.5});
        for (int i = 0; i < 1000; ++i)
            add_dynamic(scene, {5.0 * (i % 40) + random.range(-1.5, 1.5), 0.5 + 0.5 * (i / 40)},
                        i % 3 == 0 ? Geometry{Circle{.radius = 0.2f}} : Geometry{box(0.2f, 0.2f)}, {.restitution = 0.3f},
                        random.vec(3));
        std::vector<std::uint64_t> result;
        for (int i = 0; i < (slow_build ? 30 : 150); ++i)
        {
            scene.step(1.0f / 60);
            result.push_back(scene.state_hash());
        }
        return result;
    };
    const std::vector<std::uint64_t> serial = hashes({});
    EXPECT_EQ(hashes({.worker_count = 3, .run = run_on_threads}), serial);
    EXPECT_EQ(hashes({.worker_count = 2, .run = run_backwards}), serial);
}

TEST(DeterminismThreads, TheHookIsUsed)
{
    static std::atomic<int> calls;
    calls = 0;
    SceneDef def;
    def.tasks = {.worker_count = 2,
                 .run = [](void*, int count, void (*task)(void*, int), void* context)
                 {
                     ++calls;
                     for (int i = 0; i < count; ++i)
                         task(context, i);
                 }};
    Scene scene(def);
    for (int i = 0; i < 1000; ++i)
    { // tasks are given out by the hundreds of bodies
        add_static(scene, box(1, 0.5f), {}, {4.0 * i, -0.5});
        add_dynamic(scene, {4.0 * i, 0.5}, box(0.5f, 0.5f));
    }
    steps(scene, 10);
    EXPECT_GT(calls, 0);
}

TEST(DeterminismThreads, ScenesOnTheirOwnThreadsNeedNoLock)
{
    const scenes::SceneEntry& entry = scenes::all_scenes()[0];
    scenes::BuiltScene alone = entry.create({});
    const std::vector<std::uint64_t> want = run(alone, entry.h, 60);
    std::vector<std::uint64_t> got[3];
    std::vector<std::thread> threads;
    for (auto& hashes : got)
        threads.emplace_back(
            [&]
            {
                scenes::BuiltScene built = entry.create({});
                hashes = run(built, entry.h, 60);
            });
    for (std::thread& t : threads)
        t.join();
    for (const auto& hashes : got)
        EXPECT_EQ(hashes, want);
}

TEST(DeterminismHash, SeesEveryDifference)
{
    const auto build = [](auto&& change)
    {
        Scene scene;
        const Thing a = add_dynamic(scene, {0, 1}, Circle{});
        const Thing b = add_dynamic(scene, {3, 1}, box(1, 1));
        const JointId j = scene.create_joint(SpringDef{.body_a = a.body, .body_b = b.body, .stiffness = 3});
        change(scene, a, b, j);
        return scene.state_hash();
    };
    const std::uint64_t plain = build([](Scene&, const Thing&, const Thing&, JointId) {});
    EXPECT_EQ(build([](Scene&, const Thing&, const Thing&, JointId) {}), plain);
    EXPECT_NE(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.body(a.body).teleport({0, 1.0000001}, 0); }), plain);
    EXPECT_NE(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.body(a.body).set_velocity({1e-6f, 0}); }), plain);
    EXPECT_NE(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.body(a.body).apply_force({1, 0}); }), plain);
    EXPECT_NE(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.body(a.body).set_gravity_scale(0.5f); }), plain);
    EXPECT_NE(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.body(a.body).set_can_sleep(false); }), plain);
    EXPECT_NE(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.body(a.body).set_sleep_speed(0.1f); }), plain);
    EXPECT_EQ(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.body(a.body).set_sleep_speed(0.05f); }), plain)
        << "what it had";
    EXPECT_NE(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.body(a.body).set_locks({.angular = true}); }), plain);
    EXPECT_NE(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.body(a.body).set_enabled(false); }), plain);
    EXPECT_NE(build([](Scene& s, const Thing& a, const Thing&, JointId) { s.shape(a.shape).set_def({.friction = 0.1f}); }),
              plain);
    EXPECT_NE(
        build([](Scene& s, const Thing& a, const Thing&, JointId) { s.shape(a.shape).set_geometry(Circle{.radius = 0.51f}); }),
        plain);
    EXPECT_NE(build([](Scene& s, const Thing&, const Thing& b, JointId) { s.shape(b.shape).set_geometry(box(1, 0.99f)); }),
              plain);
    EXPECT_NE(build([](Scene& s, const Thing&, const Thing&, JointId j) { s.destroy(j); }), plain);
    EXPECT_NE(build([](Scene& s, const Thing&, const Thing&, JointId) { s.set_gravity({0, -9}); }), plain);
    // Not state: user data and callbacks.
    EXPECT_EQ(build(
                  [](Scene& s, const Thing& a, const Thing&, JointId j)
                  {
                      s.body(a.body).set_user_data(7);
                      s.shape(a.shape).set_user_data(8);
                      s.joint(j).set_user_data(9);
                      s.set_callbacks(a.shape, {.on_contact_begin = {},
                                                .on_impact = [](Scene&, const ImpactEvent&) {},
                                                .on_contact_end = {},
                                                .on_trigger_enter = {},
                                                .on_trigger_inside = {},
                                                .on_trigger_exit = {}});
                  }),
              plain);
}

TEST(DeterminismHash, ConstQueriesChangeNothing)
{
    Scene scene;
    add_static(scene, HalfSpace{});
    for (int i = 0; i < 20; ++i)
        add_dynamic(scene, {0.1 * i, 1.0 + i}, Circle{});
    steps(scene, 60);
    const std::uint64_t hash = scene.state_hash();
    static_cast<void>(scene.raycast_all({0, 10}, {0, -20}));
    static_cast<void>(scene.overlap_box({{-5, -5}, {5, 5}}));
    static_cast<void>(scene.closest_point({0, 0}, 10));
    DebugDraw draw;
    scene.debug_draw(draw);
    static_cast<void>(scene.contacts());
    EXPECT_EQ(scene.state_hash(), hash);
}
