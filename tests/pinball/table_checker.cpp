// Every kind of finding has a table in tables/ that is broken in this one way; the shipped tables have none.

#include "pinball/table/check_command.h"
#include "pinball/table/checker.h"
#include "pinball/table/loader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace carom::pinball {
namespace {

using Ids = std::vector<std::string>;

const std::filesystem::path broken_tables = std::filesystem::path(CAROM_SOURCE_DIR) / "tests/pinball/tables";

struct Expected
{
    FindingKind kind{};
    Ids elements{};
    friend bool operator==(const Expected&, const Expected&) = default;
    friend void PrintTo(const Expected& expected, std::ostream* out)
    {
        *out << to_string(Finding{.kind = expected.kind, .elements = expected.elements});
    }
};

struct BrokenTable
{
    std::string name{};
    std::vector<Expected> expected{};
    friend void PrintTo(const BrokenTable& table, std::ostream* out) { *out << table.name; }
};

Table load_file(const std::filesystem::path& file)
{
    const LoadResult result = load_table_file(file);
    for (const LoadError& error : result.errors)
        ADD_FAILURE() << file << ":" << to_string(error);
    return result.table.value_or(Table{});
}

std::vector<Expected> findings_of(const Table& table)
{
    std::vector<Expected> found;
    for (const Finding& finding : check(table))
        found.push_back({finding.kind, finding.elements});
    return found;
}

const std::vector<BrokenTable> all_broken_tables = {
    {"ball_in_post", {{FindingKind::Overlap, {"post"}}}},
    {"ball_in_solid", {{FindingKind::Overlap, {"block"}}}},
    {"bowl", {{FindingKind::RestingPlace, {"left", "right"}}}},
    {"bumper_in_wall", {{FindingKind::Overlap, {"bumper", "wall"}}}},
    {"captive_ball_in_wall", {{FindingKind::Overlap, {"captive", "wall"}}}},
    {"captive_balls_overlap", {{FindingKind::Overlap, {"captive1", "captive2"}}}},
    {"crossed_solid", {{FindingKind::BadOutline, {"bow"}}, {FindingKind::RestingPlace, {"bow"}}}},
    {"drop_targets_overlap", {{FindingKind::Overlap, {"drop1", "drop2"}}}},
    {"flipper_through_wall", {{FindingKind::FlipperStroke, {"flipper", "wall"}}}},
    {"flippers_cross", {{FindingKind::FlipperStroke, {"left", "right"}}}},
    {"leak", {{FindingKind::Leak, {"outer"}}}},
    {"level_ledge", {{FindingKind::RestingPlace, {"ledge"}}}},
    {"narrow_lane", {{FindingKind::NarrowGap, {"guide1", "guide2"}}, {FindingKind::RestingPlace, {"guide1", "guide2"}}}},
    {"narrow_posts", {{FindingKind::NarrowGap, {"post1", "post2"}}, {FindingKind::RestingPlace, {"post1", "post2"}}}},
    {"no_flippers", {{FindingKind::NoFlipper, {}}}},
    {"no_drain", {{FindingKind::NoDrain, {}}, {FindingKind::RestingPlace, {"floor"}}}},
    {"plunger_has_no_room", {{FindingKind::NoRoom, {"plunger", "post"}}}},
    {"plunger_lane_misses_ball", {{FindingKind::Plunger, {"plunger", "lane"}}}},
    {"plunger_misses_ball", {{FindingKind::Plunger, {"plunger"}}}},
    {"post_outside", {{FindingKind::OutsideTable, {"post"}}}},
    {"rest_on_target", {{FindingKind::RestingPlace, {"drop1", "wall"}}}},
    {"round_bowl", {{FindingKind::RestingPlace, {"bowl"}}}},
    {"saucer_in_post", {{FindingKind::Overlap, {"saucer", "post"}}}},
    {"sound", {}},
    {"start_outside", {{FindingKind::OutsideTable, {}}}},
    {"step_at_flipper", {{FindingKind::Step, {"guide_left", "flipper_left"}}}},
    {"target_has_no_room", {{FindingKind::NoRoom, {"bash", "roof"}}}},
    {"wall_outside", {{FindingKind::OutsideTable, {"wall"}}}},
    {"walled_in", {{FindingKind::Unreachable, {"standup"}}, {FindingKind::Unreachable, {"rollover"}}}},
};

class TableChecker : public testing::TestWithParam<BrokenTable>
{};

TEST_P(TableChecker, FindsExactlyWhatIsBroken)
{
    const Table table = load_file(broken_tables / (GetParam().name + ".table.json"));
    ASSERT_FALSE(table.elements.empty());
    std::vector<Expected> found = findings_of(table);
    // Most of these tables are too small to have a flipper; one is about that.
    const Expected no_flipper{FindingKind::NoFlipper, {}};
    const bool plays =
        std::ranges::any_of(table.elements, [](const Element& e) { return std::holds_alternative<Flipper>(e.part); });
    EXPECT_EQ(std::ranges::count(found, no_flipper), plays ? 0 : 1);
    if (GetParam().name != "no_flippers")
        std::erase(found, no_flipper);
    EXPECT_EQ(found, GetParam().expected);
}

INSTANTIATE_TEST_SUITE_P(Tables, TableChecker, testing::ValuesIn(all_broken_tables),
                         [](const auto& test) { return test.param.name; });

TEST(TableChecker, EveryBrokenTableIsTested)
{
    std::set<std::string> tested;
    for (const BrokenTable& table : all_broken_tables)
        tested.insert(table.name + ".table.json");
    for (const auto& entry : std::filesystem::directory_iterator(broken_tables))
        EXPECT_TRUE(tested.contains(entry.path().filename().string())) << entry.path();
}

TEST(TableChecker, EveryKindOfFindingHasABrokenTable)
{
    std::set<FindingKind> kinds;
    for (const BrokenTable& table : all_broken_tables)
        for (const Expected& expected : table.expected)
            kinds.insert(expected.kind);
    EXPECT_EQ(kinds.size(), static_cast<std::size_t>(FindingKind::NoFlipper) + 1);
}

TEST(TableChecker, ShippedTablesPass)
{
    for (const auto& entry : std::filesystem::directory_iterator(CAROM_TABLES_DIR))
    {
        std::ostringstream out;
        EXPECT_EQ(check_command(entry.path(), out), 0) << out.str();
    }
}

/// The shipped table with one element moved.
template <typename Kind, typename Change>
std::vector<Expected> momentum_with(const std::string& id, const Change& change)
{
    Table table = load_file(std::filesystem::path(CAROM_TABLES_DIR) / "momentum.table.json");
    const Index element = table.find(id);
    if (element == none)
        return {};
    change(std::get<Kind>(table.elements[element].part));
    return findings_of(table);
}

TEST(TableChecker, FindsTheBashTargetsMissingRoomOnTheRealTable)
{
    const auto found = momentum_with<SprungTarget>("bash", [](SprungTarget& bash) { bash.pos.y += 0.003f; });
    EXPECT_EQ(found, (std::vector<Expected>{{FindingKind::NoRoom, {"bash", "bash_roof"}}}));
}

TEST(TableChecker, FindsACaptiveLaneNarrowerThanTheBallOnTheRealTable)
{
    const auto found = momentum_with<Solid>("island_right", [](Solid& island) { island.path.half_thickness = 0.004f; });
    const Expected first{FindingKind::Overlap, {"captive1", "island_right"}};
    const Expected second{FindingKind::Overlap, {"captive2", "island_right"}};
    EXPECT_NE(std::find(found.begin(), found.end(), first), found.end());
    EXPECT_NE(std::find(found.begin(), found.end(), second), found.end());
}

TEST(TableChecker, FindsALongerFlipperOnTheRealTable)
{
    const auto found = momentum_with<Flipper>("flipper_left", [](Flipper& flipper) { flipper.length = 0.12f; });
    const Expected expected{FindingKind::FlipperStroke, {"flipper_left", "flipper_right"}};
    EXPECT_NE(std::find(found.begin(), found.end(), expected), found.end());
}

TEST(TableChecker, CommandNamesFileLineAndElement)
{
    std::ostringstream out;
    const std::filesystem::path file = broken_tables / "narrow_posts.table.json";
    EXPECT_EQ(check_command(file, out), 1);
    EXPECT_NE(out.str().find(file.string() + ":9: narrow gap \"post1\", \"post2\": the gap is 20.4 mm"), std::string::npos)
        << out.str();
    EXPECT_NE(out.str().find("3 findings"), std::string::npos) << out.str();
}

TEST(TableChecker, CommandRefusesAFileThatIsNotThere)
{
    std::ostringstream out;
    EXPECT_EQ(check_command(broken_tables / "nothing.table.json", out), 1);
    EXPECT_NE(out.str().find("there is no file"), std::string::npos) << out.str();
}

/// Two walls that open to the upper right: the lower one at this angle, the upper one further up by the other.
std::string pocket(float lower_deg, float opening_deg)
{
    const auto end = [](float degrees)
    {
        const Rotation turn = Rotation::from_angle(degrees * pi / 180);
        return std::to_string(0.1f + 0.16f * turn.c) + ", " + std::to_string(0.25f + 0.16f * turn.s);
    };
    return R"({"format": "pinball-table", "version": 1, "name": "pocket", "size": [0.4, 0.7], "outline": "outer",
  "ball": {"radius": 0.0135, "mass": 0.08, "spawn": [0.3, 0.3], "material": "rubber"},
  "physics": {"slope_deg": 6.5, "mu_playfield": 0.12},
  "materials": {"rubber": {"restitution": 0.8, "friction": 0.3}},
  "elements": [
    {"id": "outer", "type": "wall", "material": "rubber", "path": [["M", 0.01, 0], ["L", 0.01, 0.5], ["A", 0.2, 0.5, 0.19, 180, 0], ["L", 0.39, 0]]},
    {"id": "lower", "type": "wall", "material": "rubber", "radius": 0.002, "path": [["M", 0.1, 0.25], ["L", )" +
           end(lower_deg) + R"(]]},
    {"id": "upper", "type": "wall", "material": "rubber", "radius": 0.002, "path": [["M", 0.1, 0.25], ["L", )" +
           end(lower_deg + opening_deg) + R"(]]},
    {"id": "drain", "type": "sensor", "pos": [0.2, 0.03], "half": [0.19, 0.03], "kills": true}]})";
}

TEST(TableChecker, FindsPocketsHoweverPointed)
{
    for (const float lower : {15.0f, 35.0f, 55.0f})
        for (const float opening : {13.0f, 18.0f, 25.0f, 35.0f, 60.0f, 90.0f})
        {
            const LoadResult result = load_table(pocket(lower, opening));
            ASSERT_TRUE(result.table);
            const std::vector<Finding> findings = check(*result.table);
            EXPECT_TRUE(std::ranges::any_of(findings, [](const Finding& f) { return f.kind == FindingKind::RestingPlace; }))
                << lower << ", " << opening;
        }
}

} // namespace
} // namespace carom::pinball
