// docs/make-a-table.md, followed step by step: the file that comes out plays, and the checker says what the page says it does.

#include "pinball/headless/run.h"
#include "pinball/table/checker.h"
#include "pinball/table/loader.h"
#include "pinball/table/new_table.h"

#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace carom::pinball::test {
namespace {

std::vector<std::string> json_blocks_of_the_page()
{
    std::ifstream in(CAROM_TABLES_DIR "/../../docs/make-a-table.md");
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    const std::string begin = "```json\n";
    std::vector<std::string> blocks;
    for (std::size_t at = text.find(begin); at != std::string::npos; at = text.find(begin, at))
    {
        at += begin.size();
        const std::size_t end = text.find("```", at);
        blocks.push_back(text.substr(at, end - at));
    }
    return blocks;
}

class Author
{
public:
    std::string file = new_table("First light", {"lanes", "bumpers"});

    void put_into(const std::string& section, const std::string& lines)
    {
        const std::string head = '"' + section + "\": ";
        const std::size_t at = file.find(head);
        ASSERT_NE(at, std::string::npos) << section;
        file.insert(at + head.size() + 1, '\n' + lines);
    }

    [[nodiscard]] std::vector<Finding> findings() const
    {
        const LoadResult result = load_table(file);
        for (const LoadError& error : result.errors)
            ADD_FAILURE() << to_string(error);
        return result.table ? check(*result.table) : std::vector<Finding>{};
    }
};

TEST(Tutorial, EndsWithATableThatPlays)
{
    const std::vector<std::string> blocks = json_blocks_of_the_page();
    ASSERT_EQ(blocks.size(), 7u) << "a line, a target, its roof, two targets and a light, a group, a rule, a card";
    Author author;
    EXPECT_NE(author.file.find("\"pop1\""), std::string::npos) << "the line that the page shows";
    author.put_into("elements", blocks[1]);
    const std::vector<Finding> complaints = author.findings();
    ASSERT_EQ(complaints.size(), 1u);
    EXPECT_EQ(complaints[0].kind, FindingKind::RestingPlace);
    EXPECT_EQ(complaints[0].elements, std::vector<std::string>{"middle"});
    author.put_into("elements", blocks[2]);
    EXPECT_TRUE(author.findings().empty());
    author.put_into("elements", blocks[3]);
    author.put_into("groups", blocks[4].substr(0, blocks[4].size() - 1) + ",\n");
    author.put_into("rules", blocks[5]);
    author.put_into("card", blocks[6]);
    EXPECT_TRUE(author.findings().empty());
    const Table table = *load_table(author.file).table;
    HeadlessRun run(table, 3);
    while (run.stats().balls() < 20)
        run.step();
    EXPECT_EQ(run.stats().escaped() + run.stats().stuck(), 0);
}

} // namespace
} // namespace carom::pinball::test
