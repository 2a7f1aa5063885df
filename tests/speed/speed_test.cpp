// The benchmark measures what it says: the translation for peers, its schedule, the quality, the threads.

#include "speed/memory.h"
#include "speed/plan.h"
#include "speed/run.h"
#include "speed/task_pool.h"

#include <gtest/gtest.h>

namespace speed {
namespace {

using carom::BodyType;
using carom::Scene;
using carom::scenes::SceneEntry;

/// Stands still, wherever its bodies were put.
class StillContestant final : public Contestant
{
public:
    void step(float) override {}
    Scene& scene() override { return m_scene; }
    std::vector<truth::State> states() override { return placed; }
    int contacts() override { return 0; }
    std::uint64_t hash() override { return 0; }
    std::size_t bytes() const override { return 0; }

    carom::BodyId add(BodyType type, truth::Vec at, const carom::Geometry& geometry)
    {
        const carom::BodyId body = m_scene.create_body({.type = type, .position = {at.x, at.y}});
        m_scene.create_shape(body, geometry);
        placed.push_back({.position = at});
        return body;
    }
    std::vector<truth::State> placed;

private:
    Scene m_scene;
};

TEST(TaskPool, RunsEveryTaskOnceInEveryRound)
{
    for (const int threads : {1, 2, 3, 8})
    {
        TaskPool pool(threads);
        const carom::TaskHooks hooks = pool.hooks();
        ASSERT_EQ(hooks.run != nullptr, threads > 1);
        std::vector<int> runs(50);
        for (int round = 0; hooks.run != nullptr && round < 200; ++round)
            hooks.run(
                hooks.user, static_cast<int>(runs.size()),
                [](void* list, int i) { ++(*static_cast<std::vector<int>*>(list))[static_cast<std::size_t>(i)]; }, &runs);
        for (const int times : runs)
            EXPECT_EQ(times, threads > 1 ? 200 : 0);
    }
}

TEST(Plan, HasEveryBodyShapeAndHingeOfTheTen)
{
    for (const SceneEntry& entry : carom::scenes::benchmark_scenes())
    {
        SCOPED_TRACE(entry.name);
        carom::scenes::BuiltScene built = entry.create({});
        built.step(entry.h);
        Translator translator;
        const Changes all = translator.look(built.scene);
        std::size_t shapes = 0;
        for (const BodyPlan& body : all.bodies)
            shapes += body.shapes.size() + body.rings.size();
        EXPECT_EQ(all.bodies.size(), built.scene.bodies().size());
        EXPECT_EQ(all.hinges.size(), built.scene.joints().size());
        std::size_t want = 0;
        for (const carom::BodyId body : built.scene.bodies())
            want += built.scene.body(body).shapes().size();
        EXPECT_EQ(shapes, want);
        const Changes nothing = translator.look(built.scene);
        EXPECT_TRUE(nothing.bodies.empty() && nothing.hinges.empty() && nothing.gone.empty());
    }
}

TEST(Plan, SaysWhatPeersHaveNot)
{
    Scene scene;
    const carom::BodyId body = scene.create_body({});
    scene.create_shape(body, carom::HalfSpace{});
    EXPECT_THROW((void)Translator().look(scene), truth::Missing);
}

TEST(Plan, FollowsBodiesThatComeAndGo)
{
    Scene scene;
    const carom::BodyId first = scene.create_body({.type = BodyType::Dynamic});
    const carom::BodyId second = scene.create_body({.type = BodyType::Dynamic});
    Translator translator;
    EXPECT_EQ(translator.look(scene).bodies.size(), 2u);
    scene.destroy(first);
    const carom::BodyId third = scene.create_body({.type = BodyType::Dynamic}); // in the slot of the first
    const Changes changes = translator.look(scene);
    EXPECT_EQ(changes.gone, std::vector<truth::Body>{0});
    EXPECT_EQ(changes.bodies.size(), 1u);
    EXPECT_EQ(translator.number(second), 1);
    EXPECT_EQ(translator.number(third), 2);
}

TEST(Quality, MeasuresOverlapsOfPairsThatMayTouch)
{
    StillContestant still;
    still.add(BodyType::Static, {0, -1}, carom::box(10, 1));
    still.add(BodyType::Dynamic, {0, 0.49}, carom::box(0.5f, 0.5f)); // 1 cm deep
    still.add(BodyType::Dynamic, {3, 0.27}, carom::Circle{.radius = 0.3f});
    still.add(BodyType::Dynamic, {6, 0.31}, carom::Circle{.radius = 0.3f}); // 1 cm above
    still.add(BodyType::Dynamic, {9, 0.4}, carom::Circle{.radius = 0.3f});
    still.add(BodyType::Static, {0, -1}, carom::box(10, 1)); // as deep as can be in the other, and static
    QualityMeter meter(false);
    meter.start(still);
    meter.sample(still);
    const Quality quality = meter.result();
    EXPECT_EQ(quality.near_pairs, 6); // three bodies over two floors
    EXPECT_NEAR(quality.overlap.worst, 0.03, 1e-6);
    EXPECT_NEAR(quality.overlap.mean, 0.02, 1e-6);
    EXPECT_TRUE(std::isnan(quality.drift.worst));
    EXPECT_TRUE(std::isnan(quality.joint.worst));
}

TEST(Quality, MeasuresJointsDriftSpeedAndEnergy)
{
    StillContestant still;
    const carom::BodyId a = still.add(BodyType::Dynamic, {0, 0}, carom::box(0.5f, 0.5f));
    const carom::BodyId b = still.add(BodyType::Dynamic, {1, 0}, carom::box(0.5f, 0.5f));
    still.scene().create_joint(carom::RevoluteDef{.body_a = a, .body_b = b, .anchor_a = {0.5f, 0}, .anchor_b = {-0.5f, 0}});
    QualityMeter meter(true);
    meter.start(still);
    still.placed[1].position = {0.9, 0.2};
    still.placed[1].velocity = {0.3, 0.4};
    still.placed[1].spin = 3;
    meter.sample(still);
    meter.count(still);
    still.placed[1].awake = false;
    still.placed[1].velocity = {};
    meter.count(still);
    const Quality quality = meter.result();
    EXPECT_NEAR(quality.joint.worst, std::hypot(0.1, 0.2), 1e-9);
    EXPECT_NEAR(quality.drift.worst, std::hypot(0.1, 0.2), 1e-9);
    EXPECT_NEAR(quality.speed.mean, 0.25, 1e-9);
    EXPECT_NEAR(quality.energy, 0.5 * (0.25 + 9.0 / 6), 1e-6); // 1 kg, 1/6 kg m²
    EXPECT_EQ(quality.near_pairs, 0);                          // they are joined
    EXPECT_EQ(quality.awake, 1.5);
    EXPECT_EQ(quality.moving, 0.5);
}

TEST(Run, EveryEngineTakesTheJunkyardsPusherWithIt)
{
    const SceneEntry* entry = carom::scenes::find_scene("junkyard");
    ASSERT_NE(entry, nullptr);
    for (const Contender& contender : contenders())
    {
        SCOPED_TRACE(contender.name);
        const std::unique_ptr<Contestant> contestant = contender.enter(entry->create, {});
        for (int i = 0; i < 30; ++i)
        {
            contestant->prepare(entry->h);
            contestant->step(entry->h);
        }
        EXPECT_NEAR(contestant->states().back().position.x, 60 * std::sin(0.2 * 29 / 60), 1e-3);
    }
}

TEST(Run, EveryEngineHasAsManyFiguresInTheRain)
{
    const SceneEntry* entry = carom::scenes::find_scene("rain");
    ASSERT_NE(entry, nullptr);
    for (const Contender& contender : contenders())
    {
        const Result result = run(*entry, contender, {.steps = 17});
        EXPECT_EQ(result.bodies, 1 + 3 * 25 * 11) << contender.name;
        EXPECT_EQ(result.joints, 3 * 25 * 10) << contender.name;
        EXPECT_LT(result.quality.joint.worst, 0.1) << contender.name; // hung on the right places
    }
}

TEST(Run, RepeatsAndThreadsEndInTheSameState)
{
    const SceneEntry* entry = carom::scenes::find_scene("mixed_pile");
    ASSERT_NE(entry, nullptr);
    const Contender carom = contenders().front();
    const Result one = run(*entry, carom, {.steps = 40, .repeat = 2});
    EXPECT_TRUE(one.repeats);
    EXPECT_EQ(one.hash, run(*entry, carom, {.steps = 40, .threads = 3}).hash);
    EXPECT_EQ(one.hash, hashes(*entry, carom, {.steps = 40}).back());
    EXPECT_NE(one.hash, run(*entry, carom, {.steps = 41}).hash);
}

// Rain's figures come while it runs.
TEST(Run, EachDisturbedRunIsOneOfItsOwn)
{
    const SceneEntry* rain = carom::scenes::find_scene("rain");
    ASSERT_NE(rain, nullptr);
    const Contender carom = contenders().front();
    const auto energy = [&](int disturbed) { return run(*rain, carom, {.steps = 20, .disturbed = disturbed}).quality.energy; };
    const double first = energy(1);
    EXPECT_NE(first, energy(0));
    EXPECT_NE(first, energy(2)) << "the mean of two";
    EXPECT_NEAR(first, energy(2), 0.05 * first);
}

// As much of the scene's time has gone by: were the steps as long as before, four times as many pieces would lie together.
TEST(Run, FinerStepsAreShorterAndMore)
{
    const SceneEntry* tumbler = carom::scenes::find_scene("tumbler");
    ASSERT_NE(tumbler, nullptr);
    const Contender carom = contenders().front();
    const double near = run(*tumbler, carom, {.steps = 60}).quality.near_pairs;
    const Result finer = run(*tumbler, carom, {.steps = 60, .finer = 4});
    EXPECT_EQ(finer.steps, 240);
    EXPECT_NEAR(finer.quality.near_pairs, near, 0.2 * near);
}

// Rain makes figures every eighth step of 1/60 s, a pusher ploughs through the junkyard to and fro.
TEST(Run, SchedulesKeepTheirTimeWithFinerSteps)
{
    const SceneEntry* rain = carom::scenes::find_scene("rain");
    const SceneEntry* junkyard = carom::scenes::find_scene("junkyard");
    ASSERT_TRUE(rain != nullptr && junkyard != nullptr);
    const Contender carom = contenders().front();
    EXPECT_EQ(run(*rain, carom, {.steps = 16}).bodies, 1 + 2 * 5 * 5 * 11);
    EXPECT_EQ(run(*rain, carom, {.steps = 16, .finer = 2}).bodies, 1 + 2 * 5 * 5 * 11);
    EXPECT_EQ(run(*rain, carom, {.steps = 17, .finer = 2}).bodies, 1 + 3 * 5 * 5 * 11);

    const auto pusher_after = [&](int steps, float h)
    {
        carom::scenes::BuiltScene built = junkyard->create({});
        for (int i = 0; i < steps; ++i)
            built.step(h);
        return built.scene.body(built.scene.bodies().back()).position().x;
    };
    const double x = pusher_after(10, junkyard->h); // where it is to be when the last of these steps begins
    EXPECT_GT(x, 1.5);
    EXPECT_NEAR(pusher_after(37, junkyard->h / 4), x, 1e-5);
}

TEST(Memory, TheHeapGrowsByWhatIsAllocated)
{
    const std::size_t before = heap_bytes();
    if (before == 0)
        GTEST_SKIP() << "this allocator does not tell";
    const std::vector<char> block(10'000'000);
    EXPECT_NEAR(static_cast<double>(heap_bytes() - before), 1e7, 1e4) << block.size();
    EXPECT_GT(peak_bytes(), 10'000'000u);
}

} // namespace
} // namespace speed
