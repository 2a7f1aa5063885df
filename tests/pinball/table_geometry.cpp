// Distances between lines, arcs and circles against brute force over sampled points.

#include "pinball/table/plane_geometry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace carom::pinball {
namespace {

constexpr int samples = 400;

Point point_on(const Curve& curve, double share)
{
    return curve.is_arc ? curve.center + curve.radius * unit(curve.start + curve.sweep * share)
                        : curve.a + share * (curve.b - curve.a);
}

double sampled_distance(const Curve& curve, Point p)
{
    double least = 1e9;
    for (int i = 0; i <= samples; ++i)
        least = std::min(least, length(p - point_on(curve, double{1} * i / samples)));
    return least - curve.thickness;
}

double sampled_clearance(const Curve& a, const Curve& b)
{
    double least = 1e9;
    for (int i = 0; i <= samples; ++i)
        least = std::min(least, distance(b, point_on(a, double{1} * i / samples)) - a.thickness);
    return least;
}

class RandomCurves
{
public:
    double between(double least, double most)
    {
        return least + (most - least) * static_cast<double>(m_engine()) / static_cast<double>(std::mt19937::max());
    }
    Point point() { return {between(-1, 1), between(-1, 1)}; }
    Curve next()
    {
        const Point a = point();
        const Point b = point();
        switch (m_engine() % 3)
        {
        case 0: return make_line(a, b, between(0, 0.1));
        case 1: return make_circle(a, between(0.01, 0.3));
        default: return make_arc(a, b, between(0.2, 5.5) * (m_engine() % 2 == 0 ? 1 : -1), between(0, 0.1));
        }
    }

private:
    std::mt19937 m_engine{12345};
};

TEST(TableGeometry, ArcRunsFromEndToEnd)
{
    RandomCurves random;
    for (int i = 0; i < 1'000; ++i)
    {
        const Point a = random.point();
        const Point b = random.point();
        const Curve arc = make_arc(a, b, random.between(0.2, 5.5), 0);
        EXPECT_LT(length(point_on(arc, 0) - a), 1e-9);
        EXPECT_LT(length(point_on(arc, 1) - b), 1e-9);
    }
}

TEST(TableGeometry, PointDistanceIsThatOfTheNearestSample)
{
    RandomCurves random;
    for (int i = 0; i < 2'000; ++i)
    {
        const Curve curve = random.next();
        const Point p = random.point();
        const double sampled = sampled_distance(curve, p);
        EXPECT_LE(distance(curve, p), sampled + 1e-9);
        EXPECT_NEAR(distance(curve, p), sampled, 0.02);
    }
}

TEST(TableGeometry, ClearanceIsThatOfTheNearestSamples)
{
    RandomCurves random;
    int apart = 0;
    for (int i = 0; i < 10'000; ++i)
    {
        const Curve a = random.next();
        const Curve b = random.next();
        const double exact = closest_approach(a, b).clearance;
        const double sampled = sampled_clearance(a, b);
        ASSERT_LE(exact, sampled + 1e-9) << "pair " << i;
        ASSERT_NEAR(exact, sampled, 0.02) << "pair " << i;
        apart += exact > 0 ? 1 : 0;
    }
    EXPECT_GT(apart, 2'000);
    EXPECT_LT(apart, 8'000);
}

TEST(TableGeometry, FlattenedArcsEncloseWhatTheyShould)
{
    const Chain half_disc{.start = {1, 0}, .pieces = {{.end = {-1, 0}, .sweep = pi}, {.end = {1, 0}}}, .closed = true};
    const std::vector<Point> outline = flatten(half_disc);
    EXPECT_TRUE(contains(outline, {0, 0.99}));
    EXPECT_FALSE(contains(outline, {0, 1.01}));
    EXPECT_FALSE(contains(outline, {0.8, 0.8}));
    EXPECT_FALSE(contains(outline, {0, -0.01}));
}

} // namespace
} // namespace carom::pinball
