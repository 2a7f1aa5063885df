// Ignored pairs decide futures: they are in the hash.

#include "support/test_scene.h"

using namespace carom;
using namespace carom::test;

TEST(DeterminismHash, IgnoredPairsAreInIt)
{
    const auto hash = [](bool ignore, bool restore)
    {
        Scene scene;
        const Thing a = add_dynamic(scene, {0, 1}, Circle{});
        const Thing b = add_dynamic(scene, {3, 1}, box(1, 1));
        const std::uint64_t plain = scene.state_hash();
        if (ignore)
            scene.ignore_pair(a.body, b.body);
        if (restore)
            scene.restore_pair(a.body, b.body);
        return scene.state_hash() == plain;
    };
    EXPECT_FALSE(hash(true, false));
    EXPECT_TRUE(hash(true, true));
}
