// Every experiment with its bounds at the default step, and its errors at a quarter of that step.

#include "truth/run.h"

using namespace truth::test;

TEST(Truth, E01_ElasticBall) { expect_bounds(1); }
TEST(Truth, E02_Restitution) { expect_bounds(2); }
TEST(Truth, E03_TwoDiscs) { expect_bounds(3); }
TEST(Truth, E04_BoxCorner) { expect_bounds(4); }
TEST(Truth, E05_Inclines) { expect_bounds(5); }
TEST(Truth, E06_Pendulums) { expect_bounds(6); }
TEST(Truth, E07_Springs) { expect_bounds(7); }
TEST(Truth, E08_Cradle) { expect_bounds(8); }
TEST(Truth, E09_Billiards) { expect_bounds(9); }
TEST(Truth, E10_NothingPasses) { expect_bounds(10); }
TEST(Truth, E11_Sensors) { expect_bounds(11); }
TEST(Truth, E15_FlipperShot) { expect_bounds(15); }

TEST(Truth, E17_LongCradles) { expect_bounds(17); }
TEST(Truth, E18_BesideOthers) { expect_bounds(18); }
TEST(Truth, E20_Linkages) { expect_bounds(20); }
TEST(Truth, E24_LoadedCarts) { expect_bounds(24); }

TEST(Truth, E16_Gas)
{
    if (slow_build)
    {
        GTEST_SKIP() << "minutes in this build";
    }
    expect_bounds(16);
}

TEST(TruthShrinks, E01_ElasticBall) { expect_shrinking(1); }
TEST(TruthShrinks, E02_Restitution) { expect_shrinking(2); }
TEST(TruthShrinks, E03_TwoDiscs) { expect_shrinking(3); }
TEST(TruthShrinks, E04_BoxCorner) { expect_shrinking(4); }
TEST(TruthShrinks, E05_Inclines) { expect_shrinking(5); }
TEST(TruthShrinks, E06_Pendulums) { expect_shrinking(6); }
TEST(TruthShrinks, E07_Springs) { expect_shrinking(7); }
TEST(TruthShrinks, E08_Cradle) { expect_shrinking(8); }
TEST(TruthShrinks, E09_Billiards) { expect_shrinking(9); }
TEST(TruthShrinks, E10_NothingPasses) { expect_shrinking(10); }
TEST(TruthShrinks, E11_Sensors) { expect_shrinking(11); }
TEST(TruthShrinks, E15_FlipperShot) { expect_shrinking(15); }
TEST(TruthShrinks, E17_LongCradles) { expect_shrinking(17); }
TEST(TruthShrinks, E18_BesideOthers) { expect_shrinking(18); }

TEST(TruthAtRest, E12_Stacks) { expect_bounds(12); }

TEST(TruthAtRest, E13_ChainsStayFinite)
{
    for (const truth::Metric& m : run(13, 60))
    {
        EXPECT_TRUE(std::isfinite(m.value)) << m.name;
    }
}

class TruthPile : public testing::Test
{
protected:
    void SetUp() override
    {
        if (slow_build)
        {
            GTEST_SKIP() << "many minutes in this build";
        }
    }
};

// In some of the twenty piles that carom-truth takes a piece still rocks on another after 20 s; the median does not.
TEST_F(TruthPile, E14_APileOfAThousand)
{
    const truth::Metrics metrics = run(14, 60, does_whole_tests() ? 1 : 0.4);
    expect_bounds(metrics);
}
