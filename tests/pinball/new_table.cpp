// The templates: every set of them gives a table without findings, on which balls neither get stuck nor escape.

#include "pinball/table/new_table.h"

#include "pinball/headless/run.h"
#include "pinball/table/checker.h"
#include "pinball/table/loader.h"
#include "support/effort.h"

#include <bit>
#include <gtest/gtest.h>

namespace carom::pinball::test {
namespace {

std::vector<std::string> set_of(std::size_t bits)
{
    std::vector<std::string> names;
    const std::vector<Template> all = templates();
    for (std::size_t i = 0; i < all.size(); ++i)
        if ((bits >> i & 1) != 0)
            names.push_back(all[i].name);
    return names;
}

std::string text_of(const std::vector<std::string>& names)
{
    std::string text;
    for (const std::string& name : names)
        text += name + ' ';
    return text;
}

TEST(NewTable, EverySetOfTemplatesPassesTheChecker)
{
    ASSERT_GE(templates().size(), 5u);
    // Alone, in pairs, and all together: what does not fit meets in a pair.
    for (std::size_t bits = 0; bits < std::size_t{1} << templates().size(); ++bits)
    {
        const int count = std::popcount(bits);
        if (count > 2 && bits + 1 != std::size_t{1} << templates().size())
            continue;
        SCOPED_TRACE(text_of(set_of(bits)));
        const LoadResult result = load_table(new_table("Test", set_of(bits)));
        for (const LoadError& error : result.errors)
            ADD_FAILURE() << to_string(error);
        ASSERT_TRUE(result.table);
        EXPECT_EQ(result.table->card.size(), 1 + set_of(bits).size());
        for (const Finding& finding : check(*result.table))
            ADD_FAILURE() << to_string(finding);
    }
}

TEST(NewTable, IsPlayable)
{
    for (const std::size_t bits : {std::size_t{0}, (std::size_t{1} << templates().size()) - 1})
    {
        const Table table = *load_table(new_table("Test", set_of(bits))).table;
        HeadlessRun run(table, 5);
        while (run.stats().balls() < carom::test::part_of(20))
            run.step();
        EXPECT_EQ(run.stats().escaped(), 0);
        EXPECT_EQ(run.stats().stuck(), 0);
        EXPECT_GT(run.stats().mean_ball_time(), 5) << text_of(set_of(bits));
    }
}

TEST(NewTable, SaysWhatItDoesNotKnow)
{
    try
    {
        (void)new_table("Test", {"lanes", "loop"});
        FAIL();
    }
    catch (const std::runtime_error& error)
    {
        EXPECT_NE(std::string(error.what()).find("\"loop\""), std::string::npos);
    }
    EXPECT_TRUE(load_table(new_table("twice", {"bank", "bank"})).table);
    EXPECT_THROW((void)new_table("", {}), std::runtime_error);
    EXPECT_THROW((void)new_table(std::string(201, 'x'), {}), std::runtime_error);
    EXPECT_TRUE(load_table(new_table("a\xff", {})).table);
    EXPECT_EQ(load_table(new_table("a \"quoted\" name", {})).table->name, "a \"quoted\" name");
}

} // namespace
} // namespace carom::pinball::test
