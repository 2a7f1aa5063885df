// The ten scenes of the benchmark: the same bits with every instruction set and any number of threads.

#include "carom/carom.h"
#include "dynamics/solver/simd/kernels.h"
#include "scenes/scenes.h"
#include "support/effort.h"
#include "support/threads.h"

#include <gtest/gtest.h>
#include <string>
#include <vector>

using namespace carom;

namespace {

const int steps = test::part_of(60);

std::uint64_t hash_after(const scenes::SceneEntry& entry, int workers)
{
    SceneDef def;
    test::Threads threads(workers);
    if (workers > 1)
        def.tasks = threads.hooks();
    scenes::BuiltScene built = entry.create(def);
    for (int i = 0; i < steps; ++i)
        built.step(entry.h);
    return built.scene.state_hash();
}

class TenScenes : public ::testing::TestWithParam<const char*>
{};

TEST_P(TenScenes, EndInTheSameBits)
{
    const scenes::SceneEntry* entry = scenes::find_scene(GetParam());
    ASSERT_NE(entry, nullptr);
    const internal::WideKernels& best = internal::wide_kernels();
    const std::uint64_t want = hash_after(*entry, 1);
    for (const internal::WideKernels* kernels : internal::all_wide_kernels())
    {
        if (kernels == &best)
            continue;
        internal::use_wide_kernels(*kernels);
        EXPECT_EQ(hash_after(*entry, 1), want) << kernels->name << " against " << best.name;
    }
    internal::use_wide_kernels(best);
    for (const int workers : test::does_whole_tests() ? std::vector{2, 3, 8} : std::vector{3})
        EXPECT_EQ(hash_after(*entry, workers), want) << workers << " threads";
}

INSTANTIATE_TEST_SUITE_P(Scenes, TenScenes,
                         ::testing::Values("compounds", "joint_grid", "junkyard", "large_pyramid", "many_pyramids", "rain",
                                           "smash", "spinner", "tumbler", "washer"),
                         [](const auto& name) { return std::string(name.param); });

} // namespace
