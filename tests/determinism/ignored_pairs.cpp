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

// Whoever comes to the slot of one that is gone ignores nobody.
TEST(DeterminismHash, IgnoredPairsGoWithTheirBodies)
{
    const auto meet = [](bool had_pairs)
    {
        Scene scene;
        const BodyId ground = add_static(scene, HalfSpace{}).body;
        for (int i = 0; i < 3; ++i)
        {
            const BodyId before = add_dynamic(scene, {0, 1}, Circle{}).body;
            if (had_pairs)
                scene.ignore_pair(before, ground);
            scene.destroy(before);
        }
        const BodyId body = add_dynamic(scene, {0, 1}, Circle{}).body;
        steps(scene, 60);
        EXPECT_NEAR(scene.body(body).position().y, 0.5, 0.01);
        return scene.state_hash();
    };
    EXPECT_EQ(meet(true), meet(false));
}
