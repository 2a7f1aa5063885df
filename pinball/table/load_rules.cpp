#include "pinball/table/load_rules.h"

#include "pinball/table/load_elements.h"

#include <algorithm>
#include <utility>

namespace carom::pinball {
namespace {

constexpr std::size_t max_levels = 10;

void claim_members(FieldReader& in, Table& table, Index group)
{
    for (const Index member : table.groups[group].members)
    {
        Element& element = table.elements[member];
        if (element.group != none)
            in.fail("members", "\"" + element.id + "\" is already in the group \"" + table.groups[element.group].id + "\"");
        element.group = group;
    }
}

Group read_group(FieldReader& in, std::string id, const NameIndex& elements)
{
    constexpr std::array<std::string_view, 2> resets = {"never", "when_complete"};
    return Group{.id = std::move(id),
                 .members = in.references("members", elements, "sensor, drop target or standup"),
                 .reset = static_cast<GroupReset>(in.choice("reset", resets, 0)),
                 .reset_delay = in.number("reset_delay", range::time, 0),
                 .lane_change = in.boolean("lane_change", false),
                 .score = in.integer("score", range::score, 0)};
}

/// Everything a rule may name.
struct Names
{
    NameIndex elements{};
    NameIndex sensors{};
    NameIndex spinners{};
    NameIndex kickers{};
    NameIndex saucers{};
    NameIndex targets{};
    NameIndex groups{};
};

Names collect_names(const Table& table)
{
    Names names{.elements = names_of_all(table),
                .sensors = names_of<Sensor>(table),
                .spinners = names_of<Spinner>(table),
                .kickers = names_of<Kicker>(table),
                .saucers = names_of<Saucer>(table),
                .targets = names_of<SprungTarget, Standup, DropTarget>(table)};
    for (std::size_t i = 0; i < table.groups.size(); ++i)
        names.groups.emplace(table.groups[i].id, static_cast<Index>(i));
    return names;
}

BallSaveRule read_ball_save(FieldReader& in, const Names&)
{
    return {.time = in.number("time", range::time),
            .grace = in.number("grace", range::time, 2),
            .per_ball = in.integer("per_ball", range::count, 1)};
}

SkillShotRule read_skill_shot(FieldReader& in, const Names& names)
{
    return {.group = in.reference("group", names.groups, "group"),
            .score = in.integer("score", range::score),
            .increase = in.integer("increase", range::score, 0)};
}

LaneRule read_lanes(FieldReader& in, const Names& names)
{
    return {.group = in.reference("group", names.groups, "group"),
            .kicker = in.reference_or_none("kicker", names.kickers, "kicker")};
}

BankRule read_bank(FieldReader& in, const Names& names)
{
    BankRule rule{.group = in.reference("group", names.groups, "group"),
                  .letters = in.text("letters"),
                  .score = in.integer("score", range::score)};
    if (in.has("letters") && rule.letters.empty())
        in.fail("letters", "must have at least one letter");
    return rule;
}

std::vector<int> read_level_scores(FieldReader& in)
{
    std::vector<int> scores;
    const JsonNode* list = in.member("scores", JsonNode::Kind::Array, true);
    if (list == nullptr)
        return scores;
    if (list->items.empty() || list->items.size() > max_levels)
        in.fail(*list, "scores", "must have 1 to " + std::to_string(max_levels) + " numbers");
    for (std::size_t i = 0; i < std::min(list->items.size(), max_levels); ++i)
    {
        const JsonNode& item = list->items[i];
        const bool fits = item.kind == JsonNode::Kind::Number && item.number >= 0 && item.number <= range::score.most;
        if (!fits)
            in.fail(item, "scores[" + std::to_string(i) + "]", "must be a score between 0 and 10000000");
        scores.push_back(fits ? static_cast<int>(item.number) : 0);
    }
    return scores;
}

BumperRule read_bumpers(FieldReader& in, const Names&)
{
    return {.hits_per_level = in.integer("hits_per_level", range::count), .scores = read_level_scores(in)};
}

SpinnerRule read_spinner_rule(FieldReader& in, const Names& names)
{
    return {.spinner = in.reference("spinner", names.spinners, "spinner"),
            .trigger = in.reference("trigger", names.sensors, "sensor"),
            .factor = in.integer("factor", {1, 100, ""}),
            .time = in.number("time", range::time)};
}

ComboRule read_combo(FieldReader& in, const Names& names)
{
    return {.shots = in.references("shots", names.elements, "element"),
            .window = in.number("window", range::time),
            .score = in.integer("score", range::score),
            .max = in.integer("max", range::count)};
}

MultiballRule read_multiball(FieldReader& in, const Names& names)
{
    return {.target = in.reference("target", names.targets, "target"),
            .hits = in.integer("hits", range::count),
            .saucer = in.reference("saucer", names.saucers, "saucer"),
            .locks = in.integer("locks", {1, 5, ""}),
            .balls = in.integer("balls", {2, 8, ""}),
            .ball_save = in.number("ball_save", range::time),
            .jackpot = in.integer("jackpot", range::score),
            .jackpots = in.references("jackpots", names.elements, "element")};
}

ExtraBallRule read_extra_ball(FieldReader& in, const Names& names)
{
    return {.group = in.reference("group", names.groups, "group"),
            .completions = in.integer("completions", range::count, 1),
            .shot = in.reference("shot", names.elements, "element"),
            .per_game = in.integer("per_game", range::count, 1)};
}

ReplayRule read_replay(FieldReader& in, const Names&)
{
    constexpr std::array<std::string_view, 2> prizes = {"game", "ball"};
    return {.score = in.integer("score", {1, 1'000'000'000, ""}), .wins_a_ball = in.choice("wins", prizes, 0) == 1};
}

template <typename Rule>
std::optional<Rule> read_rule(FieldReader& in, const char* key, const Names& names, Rule (*read)(FieldReader&, const Names&))
{
    const JsonNode* node = in.member(key, JsonNode::Kind::Object, false);
    if (node == nullptr)
        return std::nullopt;
    FieldReader rule = in.child(*node, key);
    const Rule result = read(rule, names);
    rule.refuse_unknown_keys();
    return result;
}

} // namespace

void load_groups(const JsonNode& groups, Table& table, LoadErrors& errors)
{
    const NameIndex members = names_of<Sensor, DropTarget, Standup>(table);
    for (std::size_t i = 0; i < groups.items.size(); ++i)
    {
        const std::string& id = groups.keys[i];
        FieldReader in(groups.items[i], "groups." + id.substr(0, 200), "", errors);
        if (!is_valid_id(id))
            in.fail("", "the name of a group must be 1 to 40 lower-case letters, digits or underscores");
        if (groups.items[i].kind != JsonNode::Kind::Object)
        {
            in.fail("", "must be an object");
            continue;
        }
        table.groups.push_back(read_group(in, id, members));
        claim_members(in, table, static_cast<Index>(table.groups.size() - 1));
        in.refuse_unknown_keys();
    }
}

void load_card(FieldReader& in, Table& table, LoadErrors& errors)
{
    constexpr std::size_t most_entries = 16;
    constexpr std::size_t longest_name = 40;
    constexpr std::size_t longest_text = 160;
    const JsonNode* card = in.member("card", JsonNode::Kind::Array, false);
    if (card == nullptr)
        return;
    if (card->items.size() > most_entries)
        in.fail(*card, "card", "must have at most " + std::to_string(most_entries) + " entries");
    for (std::size_t i = 0; i < std::min(card->items.size(), most_entries); ++i)
    {
        FieldReader entry(card->items[i], "card[" + std::to_string(i) + "]", "", errors);
        if (card->items[i].kind != JsonNode::Kind::Object)
        {
            entry.fail("", "must be an object with \"name\" and \"text\"");
            continue;
        }
        table.card.push_back({entry.text("name"), entry.text("text")});
        if (table.card.back().name.size() > longest_name)
            entry.fail("name", "must have at most " + std::to_string(longest_name) + " bytes");
        if (table.card.back().text.size() > longest_text)
            entry.fail("text", "must have at most " + std::to_string(longest_text) + " bytes");
        entry.refuse_unknown_keys();
    }
}

void load_rules(const JsonNode& rules, Table& table, LoadErrors& errors)
{
    const Names names = collect_names(table);
    FieldReader in(rules, "rules", "", errors);
    table.rules = Rules{
        .balls = in.integer("balls", {1, 10, ""}, 3),
        .bonus_per_switch = in.integer("bonus_per_switch", range::score, 0),
        .bonus_multiplier_max = in.integer("bonus_multiplier_max", {1, 20, ""}, 1),
        .tilt_warnings = in.integer("tilt_warnings", {0, 10, ""}, 2),
        .ball_search = in.number("ball_search", range::time, 8),
        .ball_save = read_rule(in, "ball_save", names, read_ball_save),
        .skill_shot = read_rule(in, "skill_shot", names, read_skill_shot),
        .lanes = read_rule(in, "lanes", names, read_lanes),
        .bank = read_rule(in, "bank", names, read_bank),
        .bumpers = read_rule(in, "bumpers", names, read_bumpers),
        .spinner = read_rule(in, "spinner", names, read_spinner_rule),
        .combo = read_rule(in, "combo", names, read_combo),
        .multiball = read_rule(in, "multiball", names, read_multiball),
        .extra_ball = read_rule(in, "extra_ball", names, read_extra_ball),
        .replay = read_rule(in, "replay", names, read_replay),
        .match = in.boolean("match", false),
    };
    in.refuse_unknown_keys();
}

} // namespace carom::pinball
