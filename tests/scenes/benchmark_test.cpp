// The ten benchmark scenes have the bodies, shapes and joints that Box2D 3.2's program counts at its last step, and run.

#include "scene_run.h"
#include "support/effort.h"

#include <algorithm>
#include <variant>

namespace carom::scenes {
namespace {

struct Counts
{
    int bodies;
    int shapes; ///< a chain counts by its pieces
    int joints;
    friend bool operator==(const Counts&, const Counts&) = default;
    friend void PrintTo(const Counts& c, std::ostream* out)
    {
        *out << c.bodies << " bodies, " << c.shapes << " shapes, " << c.joints << " joints";
    }
};

int pieces(const Geometry& geometry)
{
    const Chain* chain = std::get_if<Chain>(&geometry);
    return chain == nullptr ? 1 : static_cast<int>(chain->pieces.size());
}

Counts count(const Scene& scene)
{
    Counts counts{0, 0, static_cast<int>(scene.joints().size())};
    for (const BodyId body : scene.bodies())
    {
        ++counts.bodies;
        for (const ShapeId shape : scene.body(body).shapes())
            counts.shapes += pieces(scene.shape(shape).geometry());
    }
    return counts;
}

struct Expected
{
    const char* name;
    int steps;
    Counts counts;
};

class BenchmarkScene : public testing::TestWithParam<Expected>
{};

TEST_P(BenchmarkScene, RunsItsFirstStepsWithoutComplaint)
{
    SceneRun run(GetParam().name);
    for (int i = 0; i < (carom::test::slow_build ? 2 : 5); ++i)
    {
        run.steps(1);
        ASSERT_TRUE(run.scene().report().quarantined.empty()) << "step " << i;
    }
}

TEST_P(BenchmarkScene, IsTakenForAsManyStepsAsTheirs)
{
    const SceneEntry* entry = find_scene(GetParam().name);
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->frames, GetParam().steps);
    EXPECT_EQ(entry->h, 1.0f / 60);
}

// Schedules add and take away bodies independently of the physics, so that nothing needs to be stepped with them.
TEST_P(BenchmarkScene, HasAsManyBodiesShapesAndJointsAsTheirs)
{
    const SceneEntry* entry = find_scene(GetParam().name);
    ASSERT_NE(entry, nullptr);
    BuiltScene built = entry->create({});
    EXPECT_EQ(built.scene.def().substeps, 4);
    if (std::string_view(GetParam().name) == "rain")
        for (int i = 0; i < entry->frames; ++i)
        {
            built.before_step(built.scene, entry->h);
            for (const BodyId id : built.scene.bodies())
                built.scene.body(id).set_enabled(false);
            built.scene.step(entry->h);
        }
    EXPECT_EQ(count(built.scene), GetParam().counts);
}

std::string name_of(const testing::TestParamInfo<Expected>& info) { return info.param.name; }

INSTANTIATE_TEST_SUITE_P(
    Scenes, BenchmarkScene,
    testing::Values(Expected{"compounds", 500, {3001, 6282, 0}}, Expected{"joint_grid", 500, {10000, 10000, 19800}},
                    Expected{"junkyard", 800, {8002, 8262, 0}}, Expected{"large_pyramid", 500, {5051, 5051, 0}},
                    Expected{"many_pyramids", 200, {22001, 22020, 0}}, Expected{"rain", 1000, {11001, 15505, 10000}},
                    Expected{"smash", 300, {9601, 9601, 0}}, Expected{"spinner", 500, {6078, 6437, 1}},
                    Expected{"tumbler", 750, {2027, 2029, 1}}, Expected{"washer", 500, {8102, 8140, 0}}),
    name_of);

TEST(BenchmarkScenes, AreTheTen) { EXPECT_EQ(benchmark_scenes().size(), 10u); }

} // namespace
} // namespace carom::scenes
