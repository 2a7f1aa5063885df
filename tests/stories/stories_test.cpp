// Checks the x-ray's stories of impacts, in every impact of every small scene of the lab and of a hundred games.

#include "pinball/autoplay/reflex.h"
#include "pinball/game/game.h"
#include "pinball/table/loader.h"
#include "scenes/scenes.h"
#include "stories/story_reader.h"
#include "support/effort.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(StoryReader, FindsWhatIsFalse)
{
    using Kind = view::StoryLine::Kind;
    const auto right = [](const char* formula) { return test::false_formula({{Kind::Formula, formula}}).empty(); };
    EXPECT_TRUE(right("m₂ = 1 / (1/1.00 + 0.500²/0.0833) = 0.250 kg"));
    EXPECT_FALSE(right("m₂ = 1 / (1/1.00 + 0.500²/0.0833) = 0.260 kg"));
    EXPECT_TRUE(right("v₁ − v₂ = 2.00 − (−1.00) = 3.00 m/s"));
    EXPECT_FALSE(right("v₁ − v₂ = 2.00 − (−1.00) = 1.00 m/s"));
    EXPECT_TRUE(right("j = (1+0.500)·2.00·0.250/(2.00+0.250)·3.00 = 1.00 N·s"));
    EXPECT_TRUE(right("j = 2.00·3.20·10⁻⁶ = 6.40·10⁻⁶ N·s"));
    EXPECT_FALSE(right("j = 2.00·3.20·10⁻⁶ = 6.40·10⁻⁵ N·s"));
}

// Every impact that the engine tells of, whoever it would show.
void read_all(const Scene& scene, int& read, int most_told, int& told)
{
    for (const ImpactEvent& event : scene.impacts())
    {
        if (!scene.is_valid(event.shape_a) || !scene.is_valid(event.shape_b))
            continue;
        const view::ImpactRecord record = view::record_impact(scene, event, view::kind_name);
        const std::string wrong = test::what_is_false(record);
        ++read;
        if (wrong.empty() || told++ >= most_told)
            continue;
        std::string story;
        for (const view::StoryLine& line : view::impact_story(record))
            story += "\n    " + line.text;
        ADD_FAILURE() << "step " << scene.step_count() << ": " << wrong << story;
    }
}

class StoriesOfScenes : public testing::TestWithParam<const scenes::SceneEntry*>
{};

TEST_P(StoriesOfScenes, AreTrue)
{
    const scenes::SceneEntry& entry = *GetParam();
    scenes::BuiltScene built = entry.create({});
    int read = 0;
    int told = 0;
    for (int i = 0; i < entry.frames / (test::slow_build ? 4 : 1) && read < 20'000; ++i)
    {
        built.step(entry.h);
        read_all(built.scene, read, 3, told);
    }
    EXPECT_EQ(told, 0) << "of " << read;
}

std::vector<const scenes::SceneEntry*> small()
{
    std::vector<const scenes::SceneEntry*> all;
    for (const scenes::SceneEntry& entry : scenes::small_scenes())
        all.push_back(&entry);
    return all;
}

INSTANTIATE_TEST_SUITE_P(SmallScenes, StoriesOfScenes, testing::ValuesIn(small()),
                         [](const auto& scene) { return std::string(scene.param->name); });

TEST(StoriesOfGames, AreTrue)
{
    using namespace pinball;
    const int games = test::part_of(100);
    int read = 0;
    int told = 0;
    for (int seed = 1; seed <= games; ++seed)
    {
        LoadResult loaded = load_table_file(CAROM_TABLES_DIR "/momentum.table.json");
        ASSERT_TRUE(loaded.table);
        Game game(std::move(*loaded.table), {.seed = static_cast<std::uint64_t>(seed)});
        ReflexPlayer player(game.table(), static_cast<std::uint64_t>(seed));
        for (int step = 0; step < 3'000; ++step)
        {
            game.step(player.play(game));
            read_all(game.scene(), read, 5, told);
        }
    }
    EXPECT_EQ(told, 0) << "of " << read;
    EXPECT_GT(read, 10 * games);
}

} // namespace
} // namespace carom
