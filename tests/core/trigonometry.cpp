// Own sin, cos, atan2 and exp against the C library's, which tests may use.

#include "core/trigonometry.h"
#include "core/pair_set.h"
#include "support/test_scene.h"

#include <limits>
#include <set>

using namespace carom;
using namespace carom::test;
using namespace carom::internal;

TEST(CoreTrigonometry, SineAndCosine)
{
    Random random(1);
    for (int i = 0; i < 200000; ++i)
    {
        const double x = i % 2 == 0 ? random.range(-10, 10) : random.range(-1e6, 1e6);
        const SinCos sc = sin_cos(x);
        ASSERT_NEAR(sc.sin, std::sin(x), 1e-15) << x;
        ASSERT_NEAR(sc.cos, std::cos(x), 1e-15) << x;
    }
    for (int k = -40; k <= 40; ++k)
    {
        const double x = k * 0.78539816339744830962;
        EXPECT_NEAR(sin_cos(x).sin, std::sin(x), 1e-15);
        EXPECT_NEAR(sin_cos(x).cos, std::cos(x), 1e-15);
    }
    EXPECT_EQ(sin_cos(0).sin, 0);
    EXPECT_EQ(sin_cos(0).cos, 1);
}

TEST(CoreTrigonometry, OfWhatIsNoNumberTheResultIsNone)
{
    for (const double x : {1e300, -1e300, std::numeric_limits<double>::infinity()})
        EXPECT_LE(std::fabs(sin_cos(x).sin), 1) << x;
    const SinCos none = sin_cos(std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(std::isnan(none.sin));
    EXPECT_TRUE(std::isnan(none.cos));
}

TEST(CoreTrigonometry, ArcTangent)
{
    Random random(2);
    for (int i = 0; i < 200000; ++i)
    {
        const double scale = std::pow(10, random.range(-8, 8));
        const double y = random.range(-1, 1) * scale;
        const double x = random.range(-1, 1);
        ASSERT_NEAR(arc_tangent(y, x), std::atan2(y, x), 2e-15) << y << ", " << x;
    }
    for (const double y : {-1.0, 0.0, 1.0})
        for (const double x : {-1.0, 0.0, 1.0})
            EXPECT_NEAR(arc_tangent(y, x), std::atan2(y, x), 1e-15) << y << ", " << x;
}

TEST(CoreTrigonometry, Exponential)
{
    Random random(3);
    for (int i = 0; i < 200000; ++i)
    {
        const double x = i % 2 == 0 ? random.range(-3, 1) : random.range(-700, 100);
        ASSERT_NEAR(exponential(x) / std::exp(x), 1, i % 2 == 0 ? 1e-15 : 4e-14) << x;
    }
    EXPECT_EQ(exponential(0), 1);
    EXPECT_EQ(exponential(-1e9), 0);
}

TEST(CoreTrigonometry, MonotoneWhereTheFunctionsAre)
{
    double sine = -2;
    double tangent = -4;
    double e = 0;
    for (int i = -100000; i <= 100000; ++i)
    {
        const double x = i * 1.57e-5;
        EXPECT_GE(sin_cos(x).sin, sine - 1e-15);
        EXPECT_GE(arc_tangent(x, 1), tangent);
        EXPECT_GE(exponential(x), e);
        sine = sin_cos(x).sin;
        tangent = arc_tangent(x, 1);
        e = exponential(x);
    }
}

TEST(CoreRotation, SmallAnglesAreRoundedOnce)
{
    Random random(5);
    int differ = 0;
    for (int i = 0; i < 100000; ++i)
    {
        const float angle = random.rangef(-0.26, 0.26) * std::pow(10.0f, random.rangef(-6, 0));
        const Rotation q = Rotation::from_angle(angle);
        differ += q.c != static_cast<float>(std::cos(static_cast<double>(angle)));
        differ += q.s != static_cast<float>(std::sin(static_cast<double>(angle)));
        ASSERT_NEAR(q.c, std::cos(static_cast<double>(angle)), 3.1e-8);
        ASSERT_NEAR(q.s, std::sin(static_cast<double>(angle)), 1e-8);
    }
    EXPECT_LT(differ, 20);
}

TEST(CoreRotation, FromAngleAndBack)
{
    Random random(4);
    for (int i = 0; i < 20000; ++i)
    {
        const float angle = random.rangef(-100, 100);
        const Rotation q = Rotation::from_angle(angle);
        ASSERT_NEAR(q.c, std::cos(static_cast<double>(angle)), 1e-7);
        ASSERT_NEAR(q.s, std::sin(static_cast<double>(angle)), 1e-7);
        ASSERT_NEAR(std::remainder(static_cast<double>(q.angle()) - static_cast<double>(angle), 2 * 3.14159265358979323846), 0,
                    3e-7);
    }
}

TEST(CoreVectors, LengthAndNormalize)
{
    EXPECT_EQ(normalize({0, 0}), (Vec2{}));
    for (const float scale : {1e-15f, 1.0f, 1e15f})
    {
        const Vec2 n = normalize({3 * scale, -4 * scale});
        EXPECT_NEAR(n.x, 0.6, 1e-6) << scale;
        EXPECT_NEAR(n.y, -0.8, 1e-6) << scale;
        EXPECT_NEAR(length({3 * scale, -4 * scale}) / scale, 5, 1e-5) << scale;
    }
}

TEST(CorePairSet, AgreesWithASet)
{
    Random random(5);
    PairSet mine;
    std::set<std::uint64_t> want;
    for (int i = 0; i < 100000; ++i)
    {
        const std::uint64_t key = pair_key(random.below(60), random.below(60));
        if (random.chance(0.5))
        {
            EXPECT_EQ(mine.insert(key), want.insert(key).second);
        }
        else
        {
            mine.erase(key);
            want.erase(key);
        }
        if (random.chance(0.01))
        {
            const int slot = random.below(60);
            const auto is_its = [slot](std::uint64_t k) { return is_in_pair(k, slot); };
            mine.erase_if(is_its);
            std::erase_if(want, is_its);
        }
        const std::uint64_t asked = pair_key(random.below(60), random.below(60));
        ASSERT_EQ(mine.contains(asked), want.contains(asked));
    }
    EXPECT_EQ(pair_key(3, 9), pair_key(9, 3));
}
