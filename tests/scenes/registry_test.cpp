// Every small scene: builds, runs without complaint, stays finite, and gives the same hash twice.

#include "scene_run.h"

#include <cmath>
#include <set>

namespace carom::scenes {
namespace {

class EverySmallScene : public testing::TestWithParam<const SceneEntry*>
{};

TEST_P(EverySmallScene, RunsWithoutComplaintAndStaysFinite)
{
    SceneRun run(GetParam()->name);
    for (int i = 0; i < 120; ++i)
    {
        run.steps(1);
        ASSERT_FALSE(run.scene().report().has(StepFlag::BodyQuarantined)) << "step " << i;
    }
    for (const BodyId id : run.scene().bodies())
    {
        const Position p = run.scene().body(id).position();
        ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
    }
    EXPECT_GT(run.dynamic().size(), 0u);
}

TEST_P(EverySmallScene, GivesTheSameHashTwice)
{
    SceneRun first(GetParam()->name);
    SceneRun second(GetParam()->name);
    EXPECT_EQ(first.scene().state_hash(), second.scene().state_hash());
    for (int i = 0; i < 4; ++i)
    {
        const std::uint64_t before = first.scene().state_hash();
        first.steps(25);
        second.steps(25);
        ASSERT_EQ(first.scene().state_hash(), second.scene().state_hash()) << "after " << 25 * (i + 1) << " steps";
        EXPECT_NE(first.scene().state_hash(), before);
    }
}

std::string name_of(const testing::TestParamInfo<const SceneEntry*>& info) { return std::string(info.param->name); }

std::vector<const SceneEntry*> pointers()
{
    std::vector<const SceneEntry*> list;
    for (const SceneEntry& entry : small_scenes())
        list.push_back(&entry);
    return list;
}

INSTANTIATE_TEST_SUITE_P(Scenes, EverySmallScene, testing::ValuesIn(pointers()), name_of);

TEST(Registry, NamesAreUniqueAndFound)
{
    std::set<std::string_view> names;
    for (const SceneEntry& entry : all_scenes())
    {
        EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
        EXPECT_EQ(find_scene(entry.name), &entry);
        EXPECT_FALSE(entry.description.empty());
        EXPECT_GT(entry.frames, 0);
        EXPECT_LT(entry.view.lower.x, entry.view.upper.x);
        EXPECT_LT(entry.view.lower.y, entry.view.upper.y);
    }
    EXPECT_EQ(find_scene("nowhere"), nullptr);
}

// The hash must see a difference: another number of sub-steps is another future.
TEST(Registry, HashTellsDifferentFuturesApart)
{
    SceneRun usual("mixed_pile");
    SceneRun finer("mixed_pile", {.substeps = 8});
    usual.steps(60);
    finer.steps(60);
    EXPECT_NE(usual.scene().state_hash(), finer.scene().state_hash());
}

} // namespace
} // namespace carom::scenes
