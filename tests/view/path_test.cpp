#include "view/path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace carom::view {
namespace {

double area(const Path& p)
{
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
    {
        const Position a = p[i];
        const Position b = p[(i + 1) % p.size()];
        sum += a.x * b.y - a.y * b.x;
    }
    return sum / 2;
}

TEST(Path, ArcStaysWithinItsTolerance)
{
    Path path;
    append_arc(path, {1, 2}, 3, 0.4f, -2.5f, 0.001f);
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
    {
        const Position middle{(path[i].x + path[i + 1].x) / 2, (path[i].y + path[i + 1].y) / 2};
        EXPECT_NEAR(std::hypot(path[i].x - 1, path[i].y - 2), 3, 1e-5);
        EXPECT_GE(std::hypot(middle.x - 1, middle.y - 2), 3 - 0.0012);
    }
    EXPECT_NEAR(path.back().x, 1 + 3 * std::cos(0.4 - 2.5), 1e-5);
}

TEST(Path, CapsuleOutlineHasTheAreaOfTheHullOfTwoCircles)
{
    const double a = 0.5;
    const double b = 0.2;
    const double d = 2;
    const double lean = std::acos((a - b) / d);
    // Two sectors and two trapezoids of height d sin(lean).
    const double expected = a * a * (pi - lean) + b * b * lean + (a + b) * d * std::sin(lean);
    const Path path = capsule_outline({1, 1}, {1 + d * 0.6, 1 + d * 0.8}, 0.5f, 0.2f, 1e-4f);
    EXPECT_NEAR(area(path), expected, 2e-3);
}

TEST(Path, CapsuleWhoseOneEndSwallowsTheOtherIsACircle)
{
    const Path path = capsule_outline({0, 0}, {0.1, 0}, 1, 0.2f, 1e-4f);
    EXPECT_NEAR(area(path), static_cast<double>(pi), 2e-3);
}

TEST(Path, RoundedOutlineIsTheSameForBothWindings)
{
    const Path square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    Path reversed(square.rbegin(), square.rend());
    const double expected = 4 + 4 * 2 * 0.3 + static_cast<double>(pi) * 0.09;
    EXPECT_NEAR(area(rounded_outline(square, 0.3f, 1e-4f)), expected, 1e-3);
    EXPECT_NEAR(area(rounded_outline(reversed, 0.3f, 1e-4f)), expected, 1e-3);
}

// The turn of a piece decides where its centre lies, also beyond half a circle.
class ChainArc : public testing::TestWithParam<float>
{};

TEST_P(ChainArc, EveryPointIsOnOneCircleAndTheLengthIsRight)
{
    const float sweep = GetParam();
    const Path path = chain_path({.start = {0, 0}, .pieces = {{{2, 0}, sweep}}}, 1e-5f);
    const double radius = 1 / std::abs(std::sin(static_cast<double>(sweep) / 2));
    double size = 0;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
        size += std::hypot(path[i + 1].x - path[i].x, path[i + 1].y - path[i].y);
    EXPECT_NEAR(size, radius * std::abs(static_cast<double>(sweep)), 2e-3 * radius);
    // Turning left starts downwards to the right: the arc bulges below the chord.
    const auto lowest = std::ranges::min_element(path, {}, &Position::y)->y;
    const auto highest = std::ranges::max_element(path, {}, &Position::y)->y;
    EXPECT_LT(sweep > 0 ? lowest : -highest, -0.1);
    EXPECT_NEAR(sweep > 0 ? highest : lowest, std::abs(sweep) <= pi ? 0 : sweep > 0 ? highest : lowest, 1e-5);
    EXPECT_EQ(path.back(), (Position{2, 0}));
}

INSTANTIATE_TEST_SUITE_P(Sweeps, ChainArc, testing::Values(0.5f, 1.5f, 3.0f, 4.5f, 6.0f, -0.5f, -3.0f, -4.5f));

} // namespace
} // namespace carom::view
