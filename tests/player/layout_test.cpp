#include "pinball/player/layout.h"

#include "pinball/player/dot_matrix.h"
#include "pinball/table/loader.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace carom::pinball {
namespace {

struct Case
{
    float width;
    float height;
    bool landscape;
};

constexpr Case cases[] = {{400, 800, false}, {620, 1100, false}, {1080, 1920, false}, {600, 600, false},
                          {800, 600, true},  {1280, 800, true},  {1920, 1080, true},  {3840, 2160, true}};

bool apart(const Area& a, const Area& b)
{
    return a.empty() || b.empty() || a.max.x <= b.min.x || b.max.x <= a.min.x || a.max.y <= b.min.y || b.max.y <= a.min.y;
}

bool inside(const Area& a, Vec2 window)
{
    return a.min.x >= 0 && a.min.y >= 0 && a.max.x <= window.x + 1 && a.max.y <= window.y + 1;
}

TEST(PlayerLayout, NothingOverlapsAtAnySize)
{
    const Table table = *load_table_file(CAROM_TABLES_DIR "/momentum.table.json").table;
    for (const Case& c : cases)
        for (const bool xray : {false, true})
        {
            SCOPED_TRACE(std::to_string(c.width) + "x" + std::to_string(c.height) + (xray ? " x-ray" : ""));
            const Vec2 window{c.width, c.height};
            const Layout layout = lay_out(window, table, xray);
            EXPECT_EQ(layout.landscape, c.landscape);
            EXPECT_TRUE(apart(layout.table, layout.score));
            EXPECT_TRUE(apart(layout.table, layout.side));
            EXPECT_TRUE(apart(layout.score, layout.side));
            for (const Area& area : {layout.table, layout.score, layout.side})
                EXPECT_TRUE(inside(area, window));
            EXPECT_FALSE(layout.table.empty());
            EXPECT_EQ(layout.side.empty(), !xray && !c.landscape);
        }
}

TEST(PlayerLayout, TheDisplayFitsInItsArea)
{
    const Table table = *load_table_file(CAROM_TABLES_DIR "/momentum.table.json").table;
    for (const Case& c : cases)
    {
        const Layout layout = lay_out({c.width, c.height}, table, false);
        EXPECT_LE(layout.dot_pitch * DotMatrix::columns + 10, layout.score.size().x) << c.width;
        EXPECT_LE(layout.dot_pitch * DotMatrix::rows + 10, layout.score.size().y) << c.width;
        EXPECT_EQ(layout.dot_pitch, static_cast<float>(static_cast<int>(layout.dot_pitch)));
    }
}

TEST(PlayerDots, MessagesOfTheGameFit)
{
    for (const char* line :
         {"SKILL SHOT 25000", "CHAIN REACTION", "BUMPERS LEVEL 3", "JACKPOT 50000", "BALL 2 LOCKED", "PRESS ENTER"})
        EXPECT_LE(DotMatrix::width(line), DotMatrix::columns) << line;
    EXPECT_LE(DotMatrix::width("9,999,999", 2), DotMatrix::columns);
}

TEST(PlayerDots, LettersLightTheirDotsAndNoOthers)
{
    DotMatrix dots;
    dots.text(10, 3, "T");
    for (int x = 0; x < 5; ++x)
        EXPECT_EQ(dots.at(10 + x, 3), 1);
    EXPECT_EQ(dots.at(12, 9), 1);
    EXPECT_EQ(dots.at(11, 9), 0);
    EXPECT_EQ(dots.at(15, 3), 0);
    dots.text(-3, -2, "W"); // cut off, not out of bounds
    dots.text(DotMatrix::columns - 2, DotMatrix::rows - 1, "W");
}

} // namespace
} // namespace carom::pinball
