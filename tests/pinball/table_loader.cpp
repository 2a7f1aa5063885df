// Every error the loader knows, each provoked by one change to a table that loads.

#include "pinball/table/loader.h"

#include "pinball/table/checker.h"
#include "pinball/table/load_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace carom::pinball {
namespace {

/// Line 3 is the ball, line 4 the physics, line 5 the materials, line 7 the outline, line 8 what a test puts in.
std::string table_with(std::string_view element, std::string_view more = "")
{
    return R"({"format": "pinball-table", "version": 1, "name": "Test", "size": [0.5, 1],
"outline": "outer",
"ball": {"radius": 0.0135, "mass": 0.08, "spawn": [0.2, 0.3], "material": "rubber"},
"physics": {"slope_deg": 6.5, "mu_playfield": 0.12},
"materials": {"rubber": {"restitution": 0.8, "friction": 0.3}},
"elements": [
{"id": "outer", "type": "wall", "material": "rubber", "path": [["M", 0, 0], ["L", 0, 1], ["L", 0.5, 1], ["L", 0.5, 0]]})" +
           std::string(element.empty() ? "" : ",\n") + std::string(element) + "\n]" + std::string(more) + "}";
}

std::string replaced(std::string text, std::string_view from, std::string_view to)
{
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

Table load_text(std::string_view text)
{
    const LoadResult result = load_table(text);
    for (const LoadError& error : result.errors)
        ADD_FAILURE() << to_string(error);
    return result.table.value_or(Table{.elements = std::vector<Element>(2)});
}

/// The text must give exactly this one error.
void expect_error(std::string_view text, std::string_view path, std::string_view sentence, std::string_view element = "",
                  int line = 0)
{
    const LoadResult result = load_table(text);
    EXPECT_FALSE(result.table.has_value());
    ASSERT_EQ(result.errors.size(), 1u) << (result.errors.size() > 1 ? to_string(result.errors[1]) : "no error") << "\n" << text;
    const LoadError& error = result.errors[0];
    EXPECT_EQ(error.path, path);
    EXPECT_NE(error.sentence.find(sentence), std::string::npos) << error.sentence;
    EXPECT_EQ(error.element, element);
    if (line > 0)
    {
        EXPECT_EQ(error.line, line);
    }
}

constexpr std::string_view post = R"({"id": "p", "type": "post", "material": "rubber", "pos": [0.1, 0.2], "radius": 0.004})";
constexpr std::string_view flipper =
    R"({"id": "f", "type": "flipper", "material": "rubber", "input": "left", "pivot": [0.1, 0.2], "length": 0.06,
"base_radius": 0.01, "tip_radius": 0.006, "rest_deg": -30, "up_deg": 20, "inertia": 1e-4, "coil_torque": 0.8})";
constexpr std::string_view sling = R"({"id": "s", "type": "slingshot", "material": "rubber",
"corners": [[0.1, 0.3], [0.12, 0.4], [0.05, 0.35]], "radius": 0.005, "kick_speed": 1})";
constexpr std::string_view drop =
    R"({"id": "d", "type": "drop_target", "material": "rubber", "a": [0.1, 0.3], "b": [0.12, 0.3]})";
constexpr std::string_view bash = R"({"id": "b", "type": "sprung_target", "material": "rubber", "pos": [0.2, 0.4],
"half": [0.02, 0.004], "axis": [0, 2], "mass": 0.1, "max_travel": 0.005,
"springs": [{"anchor": [0.2, 0.41], "local": [0, 0], "k": 900, "rest": 0.01}]})";
constexpr std::string_view sensor = R"({"id": "s", "type": "sensor", "pos": [0.2, 0.4], "half": [0.02, 0.01]})";
constexpr std::string_view light = R"({"id": "l", "type": "light", "pos": [0.2, 0.4], "radius": 0.01, "shows": "ball_save"})";

std::string solid(std::string_view path)
{
    return R"({"id": "s", "type": "solid", "material": "rubber", "path": [)" + std::string(path) + "]}";
}

std::string wall(std::string_view path)
{
    return R"({"id": "w", "type": "wall", "material": "rubber", "path": [)" + std::string(path) + "]}";
}

// --- What loads ---------------------------------------------------------------------------------------------------

TEST(TableLoader, ReadsEveryShippedTable)
{
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CAROM_TABLES_DIR))
    {
        const LoadResult result = load_table_file(entry.path());
        EXPECT_TRUE(result.table.has_value()) << entry.path() << (result.errors.empty() ? "" : to_string(result.errors[0]));
        ++files;
    }
    EXPECT_GE(files, 2);
}

TEST(TableLoader, ReadsMomentum)
{
    const LoadResult result = load_table_file(std::filesystem::path(CAROM_TABLES_DIR) / "momentum.table.json");
    ASSERT_TRUE(result.table.has_value());
    const Table& table = *result.table;
    EXPECT_EQ(table.name, "Momentum");
    EXPECT_EQ(table.elements[table.outline].id, "outer");
    EXPECT_EQ(std::get<Plunger>(table.elements[table.find("plunger")].part).lane, table.find("shooter"));
    ASSERT_TRUE(table.rules.bank.has_value());
    const Group& bank = table.groups[table.rules.bank->group];
    EXPECT_EQ(bank.members.size(), 4u);
    EXPECT_EQ(table.groups[table.elements[bank.members[0]].group].id, "bank");
    EXPECT_EQ(table.rules.multiball->saucer, table.find("saucer"));
    EXPECT_EQ(table.find("nothing"), none);
}

TEST(TableLoader, DegreesBecomeRadians)
{
    const Table table = load_text(table_with(flipper));
    const Flipper& read = std::get<Flipper>(table.elements[1].part);
    EXPECT_FLOAT_EQ(read.rest, -30 * pi / 180);
    EXPECT_FLOAT_EQ(read.up, 20 * pi / 180);
    EXPECT_FLOAT_EQ(table.physics.slope, 6.5f * pi / 180);
}

TEST(TableLoader, CommentsAreAllowed)
{
    EXPECT_EQ(load_text("// a table\n/* of\nours */" + table_with(post)).elements[1].line, 10);
}

TEST(TableLoader, ElementsKnowTheirLine)
{
    const Table table = load_text(table_with(std::string(post) + ",\n\n" + std::string(drop)));
    EXPECT_EQ(table.elements[0].line, 7);
    EXPECT_EQ(table.elements[1].line, 8);
    EXPECT_EQ(table.elements[2].line, 10);
}

TEST(TableLoader, SolidsRunCounterClockwise)
{
    for (const char* path : {R"(["M", 0.1, 0.1], ["L", 0.2, 0.1], ["A", 0.1, 0.1, 0.1, 0, 90], ["Z"])",
                             R"(["M", 0.1, 0.1], ["L", 0.1, 0.2], ["A", 0.1, 0.1, 0.1, 90, 0], ["Z"])"})
    {
        const Table table = load_text(table_with(solid(path)));
        const Chain& chain = std::get<Solid>(table.elements[1].part).path;
        EXPECT_TRUE(chain.closed);
        EXPECT_NEAR(signed_area(chain), 3.14159265 * 0.01 / 4, 1e-8) << path;
        EXPECT_EQ(chain.pieces.back().end, chain.start);
    }
}

TEST(TableLoader, SlingshotsRunCounterClockwiseAndKeepTheirKickingEdge)
{
    for (const char* corners : {"[[0.1, 0.3], [0.12, 0.4], [0.05, 0.35]]", "[[0.12, 0.4], [0.1, 0.3], [0.05, 0.35]]"})
    {
        const Table table =
            load_text(table_with(replaced(std::string(sling), "[[0.1, 0.3], [0.12, 0.4], [0.05, 0.35]]", corners)));
        const Slingshot& read = std::get<Slingshot>(table.elements[1].part);
        EXPECT_GT(cross(read.corners[1] - read.corners[0], read.corners[2] - read.corners[0]), 0);
        EXPECT_EQ(read.corners[2], (Vec2{0.05f, 0.35f}));
    }
}

TEST(TableLoader, ArcsWithinATenthOfAMillimetreSnapToTheirPath)
{
    const Table table = load_text(table_with(wall(R"(["M", 0.10009, 0.1], ["A", 0.2, 0.1, 0.1, 180, 0])")));
    const Chain& chain = std::get<Wall>(table.elements[1].part).path;
    EXPECT_EQ(chain.start, (Vec2{0.10009f, 0.1f}));
    EXPECT_NEAR(chain.pieces[0].end.x, 0.3f, 1e-6);
    EXPECT_FLOAT_EQ(chain.pieces[0].sweep, -pi);
}

TEST(TableLoader, DirectionsHaveLengthOne)
{
    EXPECT_EQ(std::get<SprungTarget>(load_text(table_with(bash)).elements[1].part).axis, (Vec2{0, 1}));
}

TEST(TableLoader, FalloffBecomesACurve)
{
    const std::string text = replaced(table_with(""), R"("restitution": 0.8)", R"("restitution": 0.8, "falloff_per_mps": 0.2)");
    const RestitutionCurve curve = load_text(text).materials[0].curve;
    ASSERT_GT(curve.count, 2u);
    for (std::uint32_t i = 0; i < curve.count; ++i)
        EXPECT_FLOAT_EQ(curve.points[i].restitution, 0.8f / (1 + 0.2f * curve.points[i].speed));
}

TEST(TableLoader, MaterialsMayGiveACurve)
{
    const std::string text = replaced(table_with(""), R"("restitution": 0.8)", R"("curve": [[0, 0.9], [2, 0.5]])");
    const Material material = load_text(text).materials[0];
    EXPECT_EQ(material.curve.count, 2u);
    EXPECT_FLOAT_EQ(material.restitution, 0.9f);
}

TEST(TableLoader, ColorsAreRead)
{
    const Table table = load_text(table_with(replaced(std::string(post), "0.004", R"(0.004, "color": "#ffd40a")")));
    EXPECT_EQ(table.elements[1].color, (Color{255, 212, 10}));
}

std::string documentation()
{
    std::ifstream stream(std::filesystem::path(CAROM_SOURCE_DIR) / "docs/table-format.md");
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(TableLoader, TheExampleOfTheReferenceLoadsAndHasNoFinding)
{
    const std::string text = documentation();
    const std::size_t start = text.find("```json\n");
    ASSERT_NE(start, std::string::npos);
    const std::size_t end = text.find("```", start + 8);
    const LoadResult result = load_table(text.substr(start + 8, end - start - 8));
    ASSERT_TRUE(result.table.has_value()) << to_string(result.errors[0]);
    for (const Finding& finding : check(*result.table))
        ADD_FAILURE() << to_string(finding);
}

TEST(TableLoader, TheReferenceNamesEveryTypeAndFinding)
{
    const std::string text = documentation();
    for (const std::string_view type : type_names)
        EXPECT_NE(text.find("**`" + std::string(type) + "`**"), std::string::npos) << type;
    for (int kind = 0; kind <= static_cast<int>(FindingKind::Plunger); ++kind)
        EXPECT_NE(text.find("| " + std::string(name(static_cast<FindingKind>(kind))) + " |"), std::string::npos) << kind;
}

// --- Syntax -------------------------------------------------------------------------------------------------------

TEST(TableLoader, SyntaxErrorsNameTheLine)
{
    expect_error("{\n\"format\": \"pinball-table\",\n oops}", "", "not valid JSON", "", 3);
    expect_error("", "", "not valid JSON");
    expect_error(table_with(post) + "x", "", "not valid JSON");
    expect_error("{\"a\": 1e999}", "", "not valid JSON", "", 1);
    expect_error("{\"a\": \"\xff\"}", "", "not UTF-8", "", 1);
    expect_error("{\"a\": 1,, \"b\": 2}", "", "a comma too many", "", 1);
    expect_error("{\"a\": [1, 2,]}", "", "a comma too many before ]", "", 1);
    expect_error("{\"a\": 1\n \"b\": 2}", "", "a comma is missing before this", "", 2);
    expect_error("{\"a\" 1}", "", "a colon is missing after the key", "", 1);
    expect_error("{\n\"a\": [1,", "", "the file ends here, and a bracket of line 2 is still open");
    expect_error(" \n", "", "the file is empty");
}

TEST(TableLoader, KeysStandOnce) { expect_error("{\n\"format\": 1,\n\"format\": 2}", "", "\"format\" stands twice", "", 3); }

TEST(TableLoader, RefusesWhatIsTooLarge)
{
    expect_error(std::string(5u << 20, ' '), "", "larger than 4 MB");
    expect_error(std::string(100, '['), "", "nested deeper than 16");
    std::string keys = "{";
    for (int i = 0; i < 300; ++i)
        keys += (i > 0 ? ",\"k" : "\"k") + std::to_string(i) + "\":0";
    expect_error(keys + "}", "", "more than 256 keys");
    std::string many = std::string(post);
    for (int i = 0; i < 2'000; ++i)
        many += ",{}";
    const LoadErrors errors = load_table(table_with(many)).errors;
    EXPECT_TRUE(std::any_of(errors.begin(), errors.end(), [](const LoadError& error)
                            { return error.path == "elements" && error.sentence == "there are more than 2000 elements"; }));
    std::string path = R"(["M", 0.1, 0.1])";
    for (int i = 0; i < 1'000; ++i)
        path += i % 2 == 0 ? R"(,["L", 0.2, 0.1])" : R"(,["L", 0.1, 0.1])";
    expect_error(table_with(wall(path)), "elements[1].path", "more than 1000 commands", "w");
}

TEST(TableLoader, StopsCountingErrorsSomewhere)
{
    std::string many = std::string(post);
    for (int i = 0; i < 1'000; ++i)
        many += ",{}";
    EXPECT_EQ(load_table(table_with(many)).errors.size(), 200u);
}

// --- The frame ----------------------------------------------------------------------------------------------------

TEST(TableLoader, ATableIsAnObjectOfTheRightFormat)
{
    expect_error("[]", "", "one JSON object");
    expect_error(replaced(table_with(""), "pinball-table", "chess"), "format", "must be \"pinball-table\"");
    expect_error(replaced(table_with(""), "\"version\": 1", "\"version\": 2"), "version", "newer than this program");
}

TEST(TableLoader, UnknownKeysAreErrorsEverywhere)
{
    expect_error(table_with("", ", \"wall\": 1"), "wall", "is not a key", "", 8);
    expect_error(replaced(table_with(""), "\"mass\"", "\"mas\": 1, \"mass\""), "ball.mas", "is not a key");
    // Misspelt: one error, with the likely name.
    expect_error(replaced(table_with(""), "\"friction\"", "\"fricton\""), "materials.rubber.fricton", "is \"friction\" meant?");
    expect_error(replaced(table_with(""), "\"mass\"", "\"msas\""), "ball.msas", "is \"mass\" meant?");
    expect_error(replaced(table_with(""), "\"slope_deg\"", "\"slope\": 1, \"slope_deg\""), "physics.slope", "is not a key");
    expect_error(replaced(table_with(""), "\"friction\"", "\"grip\": 1, \"friction\""), "materials.rubber.grip", "is not a key");
    expect_error(table_with(replaced(std::string(post), "\"radius\"", "\"radios\": 1,\n\"radius\"")), "elements[1].radios",
                 "it has id, type, pos, radius", "p", 8);
    expect_error(table_with(replaced(std::string(bash), "\"k\"", "\"stiffness\": 1, \"k\"")), "elements[1].springs[0].stiffness",
                 "is not a key", "b");
    expect_error(table_with(post, ", \"rules\": {\"ball\": 3}"), "rules.ball", "is not a key");
    expect_error(table_with(post, ", \"rules\": {\"ball_save\": {\"time\": 3, \"x\": 1}}"), "rules.ball_save.x", "is not a key");
    expect_error(table_with(sensor, ", \"groups\": {\"g\": {\"members\": [\"s\"], \"x\": 1}}"), "groups.g.x", "is not a key");
}

TEST(TableLoader, MissingKeysAreErrors)
{
    expect_error(replaced(table_with(""), "\"name\": \"Test\",", ""), "name", "is missing", "", 1);
    expect_error(replaced(table_with(""), "\"outline\": \"outer\",", ""), "outline", "is missing");
    expect_error(replaced(table_with(""), "\"mass\": 0.08,", ""), "ball.mass", "is missing", "", 3);
    expect_error(replaced(table_with(""), ", \"mu_playfield\": 0.12", ""), "physics.mu_playfield", "is missing", "", 4);
    expect_error(replaced(table_with(""), ", \"friction\": 0.3", ""), "materials.rubber.friction", "is missing", "", 5);
    expect_error(table_with(replaced(std::string(post), ", \"radius\": 0.004", "")), "elements[1].radius", "is missing", "p", 8);
    expect_error(table_with(replaced(std::string(post), "\"id\": \"p\", ", "")), "elements[1].id", "is missing", "", 8);
    expect_error(table_with(replaced(std::string(post), "\"type\": \"post\", ", "")), "elements[1].type", "is missing", "p", 8);
    expect_error(table_with(replaced(std::string(post), "\"material\": \"rubber\", ", "")), "elements[1].material", "is missing",
                 "p");
}

TEST(TableLoader, WrongTypesAreErrors)
{
    expect_error(replaced(table_with(""), "\"name\": \"Test\"", "\"name\": 7"), "name", "must be a string, is a number", "", 1);
    expect_error(table_with(replaced(std::string(post), "0.004", "\"thick\"")), "elements[1].radius", "must be a number", "p", 8);
    expect_error(table_with(replaced(std::string(post), "[0.1, 0.2]", "[0.1]")), "elements[1].pos", "array of two numbers", "p");
    expect_error(table_with(replaced(std::string(post), "[0.1, 0.2]", "[0.1, null]")), "elements[1].pos[1]", "must be a number",
                 "p");
    expect_error(table_with(replaced(std::string(post), "0.004", "0.004, \"enabled\": 1")), "elements[1].enabled",
                 "must be true or false, is a number", "p");
    expect_error(table_with(replaced(std::string(post), "0.004", "0.004, \"score\": 1.5")), "elements[1].score",
                 "must be a whole number", "p");
    expect_error(table_with("7"), "elements[1]", "must be an object", "", 8);
    expect_error(table_with("", ", \"rules\": []"), "rules", "must be an object, is an array");
    expect_error(table_with("", ", \"groups\": {\"g\": 1}"), "groups.g", "must be an object");
    expect_error(replaced(table_with(""), "\"materials\": {", "\"materials\": {\"x\": 1, "), "materials.x", "must be an object");
    expect_error(table_with(replaced(std::string(bash), "\"springs\": [", "\"springs\": [7, ")), "elements[1].springs[0]",
                 "must be an object", "b");
}

TEST(TableLoader, ImplausibleValuesAreErrors)
{
    expect_error(replaced(table_with(""), "\"radius\": 0.0135", "\"radius\": 13.5"), "ball.radius",
                 "between 0.005 and 0.05 m, is 13.5");
    expect_error(replaced(table_with(""), "\"slope_deg\": 6.5", "\"slope_deg\": 90"), "physics.slope_deg",
                 "between 0 and 45 degrees");
    expect_error(replaced(table_with(""), "\"restitution\": 0.8", "\"restitution\": 1.1"), "materials.rubber.restitution",
                 "between 0 and 1");
    expect_error(table_with(replaced(std::string(post), "0.2]", "200]")), "elements[1].pos[1]", "between -0.5 and 3.5 m, is 200",
                 "p");
    expect_error(table_with(replaced(std::string(flipper), "\"up_deg\": 20", "\"up_deg\": -29")), "elements[1].up_deg",
                 "5 to 170 degrees", "f");
    expect_error(table_with(replaced(std::string(flipper), "\"length\": 0.06", "\"length\": 0.02, \"stop_restitution\": 2")),
                 "elements[1].stop_restitution", "between 0 and 1", "f");
    expect_error(table_with(replaced(replaced(std::string(flipper), "\"length\": 0.06", "\"length\": 0.02"), "0.01,", "0.05,")),
                 "elements[1].length", "too short for its radii", "f");
    expect_error(table_with(replaced(std::string(post), "0.004", "0.004, \"color\": \"red\"")), "elements[1].color",
                 "must be a color", "p");
}

TEST(TableLoader, RestitutionCurvesAreChecked)
{
    const auto with = [](std::string_view curve)
    { return replaced(table_with(""), R"("restitution": 0.8)", "\"curve\": " + std::string(curve)); };
    expect_error(with("[[0, 0.9]]"), "materials.rubber.curve", "2 to 8 points");
    expect_error(with("[[0, 0.9], [0, 0.5]]"), "materials.rubber.curve[1]", "speeds must ascend");
    expect_error(with("[[0, 0.9], [1, 1.5]]"), "materials.rubber.curve[1]", "restitution of 0 to 1");
    expect_error(with("[[0, 0.9], [1, 0.5]], \"restitution\": 0.5"), "materials.rubber.curve", "give one or the other");
}

// --- Elements -----------------------------------------------------------------------------------------------------

TEST(TableLoader, IdsAreUniqueAndSimple)
{
    expect_error(table_with(std::string(post) + ",\n" + std::string(post)), "elements[2].id", "is taken", "p", 9);
    expect_error(table_with(replaced(std::string(post), "\"p\"", "\"P 1\"")), "elements[1].id", "lower-case letters", "P 1");
    expect_error(table_with(sensor, ", \"groups\": {\"G\": {\"members\": [\"s\"]}}"), "groups.G", "name of a group");
    expect_error(replaced(table_with(""), "\"materials\": {", "\"materials\": {\"A b\": {\"restitution\": 0, \"friction\": 0}, "),
                 "materials.A b", "name of a material");
}

TEST(TableLoader, UnknownTypesAreErrorsAndNothingElse)
{
    expect_error(table_with(R"({"id": "x", "type": "magnet", "strength": 1})"), "elements[1].type", "one of wall, solid", "x", 8);
}

TEST(TableLoader, DanglingNamesAreErrors)
{
    expect_error(table_with(replaced(std::string(post), "rubber", "steel")), "elements[1].material", "no material \"steel\"", "p",
                 8);
    expect_error(replaced(table_with(""), "\"outline\": \"outer\"", "\"outline\": \"inner\""), "outline", "no wall \"inner\"", "",
                 2);
    expect_error(replaced(table_with(post), "\"outline\": \"outer\"", "\"outline\": \"p\""), "outline", "no wall \"p\"");
    expect_error(table_with(replaced(std::string(light), "\"ball_save\"", "\"element\", \"element\": \"x\"")),
                 "elements[1].element", "no element \"x\"", "l");
    expect_error(table_with(replaced(std::string(light), "\"ball_save\"", "\"element\"")), "elements[1].element", "is missing",
                 "l");
    expect_error(table_with(replaced(std::string(light), "\"ball_save\"", "\"bonus\"")), "elements[1].number", "is missing", "l");
    expect_error(table_with(sensor, ", \"groups\": {\"g\": {\"members\": [\"s\", \"t\"]}}"), "groups.g.members[1]", "there is no",
                 "", 9);
    expect_error(table_with(sensor, ", \"rules\": {\"lanes\": {\"group\": \"g\"}}"), "rules.lanes.group", "no group \"g\"");
    expect_error(table_with(sensor, R"(, "rules": {"spinner": {"spinner": "s", "trigger": "s", "factor": 2, "time": 3}})"),
                 "rules.spinner.spinner", "no spinner \"s\"");
    expect_error(table_with(R"({"id": "p", "type": "plunger", "material": "rubber", "pos": [0.1, 0.1], "half": [0.01, 0.01],
"axis": [0, 1], "stroke": 0.05, "mass": 0.1, "k": 600, "lane": "lane"})"),
                 "elements[1].lane", "no sensor \"lane\"", "p", 9);
}

TEST(TableLoader, GroupsDoNotShareMembers)
{
    expect_error(table_with(sensor, R"(, "groups": {"g": {"members": ["s"]}, "h": {"members": ["s"]}})"), "groups.h.members",
                 "already in the group \"g\"");
    expect_error(table_with(sensor, R"(, "groups": {"g": {"members": ["s", "s"]}})"), "groups.g.members[1]", "names \"s\" twice");
    expect_error(table_with(sensor, R"(, "groups": {"g": {"members": []}})"), "groups.g.members", "at least one");
    expect_error(table_with(sensor, R"(, "groups": {"g": {"members": ["s"], "reset": "later"}})"), "groups.g.reset",
                 "one of never, when_complete");
    std::string many = "\"s\"";
    for (int i = 0; i < 300; ++i)
        many += ", \"s\"";
    EXPECT_EQ(load_table(table_with(sensor, ", \"groups\": {\"g\": {\"members\": [" + many + "]}}")).errors.size(), 1u);
}

TEST(TableLoader, PartsAreChecked)
{
    expect_error(table_with(replaced(std::string(sling), "[0.05, 0.35]", "[0.11, 0.35]")), "elements[1].corners",
                 "encloses no area", "s");
    expect_error(table_with(replaced(std::string(sling), ", [0.05, 0.35]", "")), "elements[1].corners",
                 "must have 3 points, has 2", "s");
    expect_error(table_with(replaced(std::string(drop), "[0.12, 0.3]", "[0.1, 0.3]")), "elements[1].b", "lies on a", "d");
    expect_error(table_with(replaced(std::string(bash), "[0, 2]", "[0, 0]")), "elements[1].axis", "must be a direction", "b");
    const std::string springs = R"([{"anchor": [0.2, 0.41], "local": [0, 0], "k": 900, "rest": 0.01}])";
    expect_error(table_with(replaced(std::string(bash), springs, "[]")), "elements[1].springs", "must have 1 to 8 springs", "b");
    expect_error(table_with(replaced(std::string(sensor), "\"half\"", "\"radius\": 0.01, \"half\"")), "elements[1].half",
                 "either half (a box) or radius", "s");
    expect_error(table_with(replaced(std::string(sensor), ", \"half\": [0.02, 0.01]", "")), "elements[1].half", "either half",
                 "s");
}

TEST(TableLoader, RulesAreChecked)
{
    expect_error(table_with("", R"(, "rules": {"bumpers": {"hits_per_level": 50, "scores": []}})"), "rules.bumpers.scores",
                 "1 to 10");
    expect_error(table_with("", R"(, "rules": {"bumpers": {"hits_per_level": 50, "scores": [-1]}})"), "rules.bumpers.scores[0]",
                 "must be a score");
    expect_error(
        table_with(sensor,
                   R"(, "groups": {"g": {"members": ["s"]}}, "rules": {"bank": {"group": "g", "letters": "", "score": 1}})"),
        "rules.bank.letters", "at least one letter");
}

// --- Paths --------------------------------------------------------------------------------------------------------

TEST(TableLoader, PathsAreChecked)
{
    const auto expect_path_error = [](std::string_view path, std::string_view place, std::string_view sentence)
    { expect_error(table_with(wall(path)), "elements[1].path" + std::string(place), sentence, "w", 8); };
    expect_path_error("", "", "at least one line or arc");
    expect_path_error(R"(["M", 0.1, 0.1])", "", "at least one line or arc");
    expect_path_error(R"(["L", 0.1, 0.1])", "[0]", "starts with \"M\"");
    expect_path_error(R"(["M", 0.1, 0.1], ["M", 0.2, 0.1])", "[1]", "one \"M\"");
    expect_path_error(R"(["M", 0.1, 0.1], ["L", 0.1, 0.1])", "[1]", "a line of no length");
    expect_path_error(R"(["M", 0.1, 0.1], ["L", 0.1])", "[1]", "needs 2 numbers after \"L\", has 1");
    expect_path_error(R"(["M", 0.1, 0.1], ["L", 0.1, "x"])", "[1]", "is not a number");
    expect_path_error(R"(["M", 0.1, 0.1], ["L", 0.1, 9])", "[1]", "must lie between");
    expect_path_error(R"(["M", 0.1, 0.1], ["Q", 0.1, 0.2])", "[1]", "\"M\", \"L\", \"A\" or \"Z\"");
    expect_path_error(R"(["M", 0.1, 0.1], 7)", "[1]", "must be an array like");
    expect_path_error(R"(["M", 0.1, 0.1], ["L", 0.2, 0.1], ["L", 0.2, 0.2], ["Z"])", "", "must not end in \"Z\"");
    expect_path_error(R"(["M", 0.1, 0.1], ["A", 0.2, 0.1, 0.1, 180, 180])", "[1]", "between 0.5 and 359.5 degrees");
    expect_path_error(R"(["M", 0.1, 0.1], ["A", 0.101, 0.1, 0.001, 180, 181])", "[1]", "at least 0.1 mm apart");
    expect_path_error(R"(["M", 0.1002, 0.1], ["A", 0.2, 0.1, 0.1, 180, 0])", "[1]", "starts 0.2 mm from where the path stands");
}

TEST(TableLoader, SolidsAreClosedOnceAndEncloseSomething)
{
    const auto expect_solid_error = [](std::string_view path, std::string_view place, std::string_view sentence)
    { expect_error(table_with(solid(path)), "elements[1].path" + std::string(place), sentence, "s", 8); };
    expect_solid_error(R"(["M", 0.1, 0.1], ["L", 0.2, 0.1], ["L", 0.2, 0.2])", "", "must end in \"Z\"");
    expect_solid_error(R"(["M", 0.1, 0.1], ["L", 0.2, 0.1], ["L", 0.2, 0.2], ["Z"], ["L", 0.1, 0.1])", "[4]",
                       "nothing follows \"Z\"");
    expect_solid_error(R"(["M", 0.1, 0.1], ["L", 0.2, 0.1], ["Z"])", "", "encloses no area");
}

TEST(TableLoader, AllErrorsAreCollected)
{
    const std::string text = replaced(table_with(replaced(std::string(post), "0.004", "9")), "\"mass\": 0.08", "\"mass\": 8");
    const LoadResult result = load_table(text);
    ASSERT_EQ(result.errors.size(), 2u);
    EXPECT_EQ(to_string(result.errors[0]).substr(0, 2), "3:");
    EXPECT_EQ(to_string(result.errors[1]).find("8:"), 0u);
    EXPECT_NE(to_string(result.errors[1]).find("element \"p\": elements[1].radius: must be between"), std::string::npos);
}

TEST(TableLoader, AMissingFileIsAnError)
{
    const LoadResult result = load_table_file("no/such/file.table.json");
    ASSERT_EQ(result.errors.size(), 1u);
    EXPECT_NE(result.errors[0].sentence.find("there is no file"), std::string::npos);
}

} // namespace
} // namespace carom::pinball
