#include "pinball/rules/high_scores.h"

#include <gtest/gtest.h>

namespace carom::pinball::test {
namespace {

TEST(HighScores, KeepsTheTenBestInOrder)
{
    HighScores scores;
    for (int i = 1; i <= 12; ++i)
        scores.insert({"ABC", i * 100});
    ASSERT_EQ(scores.entries().size(), 10u);
    EXPECT_EQ(scores.best(), 1200);
    EXPECT_EQ(scores.entries().back().score, 300);
    EXPECT_EQ(scores.insert({"LOW", 100}), -1);
    EXPECT_EQ(scores.insert({"MID", 1000}), 3) << "behind the equal one that was there first";
}

TEST(HighScores, AZeroIsNoScore)
{
    HighScores scores;
    EXPECT_EQ(scores.insert({"ABC", 0}), -1);
    EXPECT_TRUE(scores.entries().empty());
}

TEST(HighScores, NamesAreThreeLetters)
{
    HighScores scores;
    scores.insert({"a name\nthat is too long", 10});
    EXPECT_EQ(scores.entries()[0].name, "ana");
    scores.rename(0, "XY");
    EXPECT_EQ(scores.entries()[0].name, "XY");
    scores.rename(7, "no");
}

TEST(HighScores, ComeBackFromTheirText)
{
    HighScores scores;
    scores.insert({"ABC", 12'345'678'901});
    scores.insert({"D", 5});
    scores.insert({"", 7});
    EXPECT_EQ(HighScores::from_text(scores.to_text()).entries(), scores.entries());
}

TEST(HighScores, BadLinesArePassedOver)
{
    const HighScores scores = HighScores::from_text("nonsense\n\n500 ABC\n-3 NEG\n99999999999999999999999 BIG\n700");
    ASSERT_EQ(scores.entries().size(), 2u);
    EXPECT_EQ(scores.entries()[0].score, 700);
    EXPECT_EQ(scores.entries()[1].name, "ABC");
}

} // namespace
} // namespace carom::pinball::test
