// Golden hashes of whole scenes: a changed hash needs a reason in the commit that changes it.

#include "support/test_scene.h"

#include "scenes/scenes.h"

#include <cstdio>

using namespace carom;

namespace {

struct Golden
{
    const char* scene;
    int steps;
    std::uint64_t hash;
};

// Print fresh ones with --gtest_also_run_disabled_tests --gtest_filter=*PrintThem.
constexpr Golden golden[] = {
#include "determinism/golden_hashes.inc"
};

std::uint64_t hash_of(const char* name, int steps)
{
    const scenes::SceneEntry* entry = scenes::find_scene(name);
    if (entry == nullptr)
        return 0;
    scenes::BuiltScene built = entry->create({});
    for (int i = 0; i < steps; ++i)
        built.step(entry->h);
    return built.scene.state_hash();
}

} // namespace

TEST(DeterminismGolden, ScenesEndWhereTheyEnded)
{
    EXPECT_GE(std::size(golden), 6u);
    for (const Golden& g : golden)
        EXPECT_EQ(hash_of(g.scene, g.steps), g.hash) << g.scene << " after " << g.steps << " steps";
}

TEST(DeterminismGolden, DISABLED_PrintThem)
{
    for (const Golden& g : golden)
        std::printf("    {\"%s\", %d, 0x%016llxu},\n", g.scene, g.steps,
                    static_cast<unsigned long long>(hash_of(g.scene, g.steps)));
}
