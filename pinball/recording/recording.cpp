#include "pinball/recording/recording.h"

#include "pinball/table/loader.h"

#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace carom::pinball {

namespace {

using Json = nlohmann::ordered_json;

constexpr int newest_version = 1;
constexpr std::int64_t most_steps = 100'000'000;
constexpr int most_credits = 1000;
constexpr int most_balls = 8; // at once

constexpr bool Input::* buttons[] = {&Input::left,       &Input::right,       &Input::plunger, &Input::start,
                                     &Input::nudge_left, &Input::nudge_right, &Input::nudge_up};

int bits_of(const Input& input)
{
    int bits = 0;
    for (std::size_t i = 0; i < std::size(buttons); ++i)
        bits |= input.*buttons[i] ? 1 << i : 0;
    return bits;
}

Input input_of(int bits)
{
    Input input;
    for (std::size_t i = 0; i < std::size(buttons); ++i)
        input.*buttons[i] = (bits >> i & 1) != 0;
    return input;
}

// As text: a JSON number may lose bits on its way through other programs.
std::string hex(std::uint64_t value)
{
    std::array<char, 16> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, 16).ptr;
    return {digits.data(), end};
}

std::uint64_t number_of(const std::string& text)
{
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
    if (error != std::errc{} || end != text.data() + text.size())
        throw std::runtime_error("\"" + text + "\" is no hexadecimal number");
    return value;
}

Json of(const Options& options)
{
    return {{"seed", hex(options.seed)},          {"ball_save", options.ball_save}, {"kickback", options.kickback},
            {"ball_search", options.ball_search}, {"credits", options.credits},     {"balls_at_once", options.balls_at_once}};
}

// The whole number of this name, within bounds: another one is no recording of ours.
std::int64_t whole(const Json& value, const std::string& name, std::int64_t least, std::int64_t most)
{
    const bool fits = value.is_number_integer() && value >= least && value <= most;
    if (!fits)
        throw std::runtime_error("\"" + name + "\" must be a whole number from " + std::to_string(least) + " to " +
                                 std::to_string(most));
    return value.get<std::int64_t>();
}

const Json& member(const Json& json, const char* name)
{
    if (!json.is_object() || !json.contains(name))
        throw std::runtime_error(std::string("there is no \"") + name + "\"");
    return json[name];
}

std::string text_of(const Json& json, const char* name)
{
    const Json& value = member(json, name);
    if (!value.is_string())
        throw std::runtime_error(std::string("\"") + name + "\" must be a text");
    return value.get<std::string>();
}

bool flag_of(const Json& json, const char* name)
{
    const Json& value = member(json, name);
    if (!value.is_boolean())
        throw std::runtime_error(std::string("\"") + name + "\" must be true or false");
    return value.get<bool>();
}

int small(const Json& json, const char* name, int least, int most)
{
    return static_cast<int>(whole(member(json, name), name, least, most));
}

Options options_of(const Json& json)
{
    return {.seed = number_of(text_of(json, "seed")),
            .ball_save = flag_of(json, "ball_save"),
            .kickback = flag_of(json, "kickback"),
            .ball_search = flag_of(json, "ball_search"),
            .credits = small(json, "credits", 0, most_credits),
            .balls_at_once = small(json, "balls_at_once", 1, most_balls)};
}

Recording::Change change_of(const Json& json, std::int64_t last, std::int64_t steps)
{
    if (!json.is_array() || json.size() < 2 || json.size() > 3)
        throw std::runtime_error("each of \"changes\" must be [step, buttons] or [step, buttons, rod]");
    const std::int64_t step = whole(json[0], "step", last + 1, steps - 1);
    Input input = input_of(static_cast<int>(whole(json[1], "buttons", 0, (1 << std::size(buttons)) - 1)));
    if (json.size() > 2)
        input.rod = static_cast<std::uint8_t>(whole(json[2], "rod", 0, 255));
    return {step, input};
}

Recording recording_of(const Json& json)
{
    if (text_of(json, "format") != "pinball-game")
        throw std::runtime_error("its \"format\" is not \"pinball-game\"");
    if (const Json& version = member(json, "version"); version != newest_version)
        throw std::runtime_error("its version is " + version.dump() + ", and this program reads version " +
                                 std::to_string(newest_version));
    Recording recording{.table_text = text_of(json, "table"),
                        .options = options_of(member(json, "options")),
                        .steps = whole(member(json, "steps"), "steps", 0, most_steps),
                        .hash = number_of(text_of(json, "hash"))};
    const Json& scores = member(json, "scores");
    const Json& changes = member(json, "changes");
    if (!scores.is_array() || !changes.is_array())
        throw std::runtime_error("\"scores\" and \"changes\" must be lists");
    for (const Json& score : scores)
        recording.scores.push_back(whole(score, "scores", 0, std::numeric_limits<std::int64_t>::max()));
    for (const Json& change : changes)
        recording.changes.push_back(
            change_of(change, recording.changes.empty() ? -1 : recording.changes.back().step, recording.steps));
    return recording;
}

Table table_of(const Recording& recording)
{
    LoadResult result = load_table(recording.table_text);
    if (result.table)
        return std::move(*result.table);
    std::string text = "the table in the recording has errors:";
    for (const LoadError& error : result.errors)
        text += "\n  " + to_string(error);
    throw std::runtime_error(text);
}

} // namespace

std::string Recording::to_json() const
{
    Json json = {{"format", "pinball-game"}, {"version", newest_version}, {"options", of(options)},
                 {"steps", steps},           {"scores", scores},          {"hash", hex(hash)}};
    Json& list = json["changes"] = Json::array();
    for (const Change& change : changes)
    {
        Json entry = {change.step, bits_of(change.input)};
        if (change.input.rod != 0)
            entry.push_back(change.input.rod);
        list.push_back(std::move(entry));
    }
    json["table"] = table_text;
    // A table may hold any bytes in its comments.
    return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Beside it first: a file that is there is a whole one.
std::string Recording::save(const std::filesystem::path& file) const
{
    const std::filesystem::path unfinished = file.string() + ".new";
    std::ofstream out(unfinished, std::ios::binary);
    out << to_json();
    out.close();
    std::error_code error;
    if (out)
        std::filesystem::rename(unfinished, file, error);
    return out && !error ? std::string() : file.string() + ": the game cannot be written there";
}

LoadedRecording read_recording(std::string_view json)
{
    try
    {
        return {.recording = recording_of(Json::parse(json))};
    }
    catch (const Json::parse_error& error)
    {
        return {.trouble = "not a recorded game: no JSON at byte " + std::to_string(error.byte)};
    }
    catch (const std::exception& error)
    {
        return {.trouble = std::string("not a recorded game: ") + error.what()};
    }
}

LoadedRecording load_recording(const std::filesystem::path& file)
{
    std::ifstream in(file, std::ios::binary);
    if (!in)
        return {.trouble = "cannot read " + file.string()};
    const std::string text((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    LoadedRecording loaded = read_recording(text);
    if (!loaded.recording)
        loaded.trouble = file.string() + ": " + loaded.trouble;
    return loaded;
}

std::vector<std::int64_t> scores_of(const Game& game)
{
    std::vector<std::int64_t> scores;
    for (int player = 0; player < game.players(); ++player)
        scores.push_back(game.score(player));
    return scores;
}

// --- Recorder --------------------------------------------------------------------------------------------------------

Recorder::Recorder(std::string table_text, const Options& options)
    : m_recording{.table_text = std::move(table_text), .options = options}
{}

void Recorder::note(const Input& input)
{
    if (input != m_held)
        m_recording.changes.push_back({m_recording.steps, input});
    m_held = input;
    ++m_recording.steps;
}

Recording Recorder::recording(const Game& game) const
{
    Recording all = m_recording;
    all.scores = scores_of(game);
    all.hash = game.state_hash();
    return all;
}

// --- Playback --------------------------------------------------------------------------------------------------------

bool Playback::came_out_the_same(const Game& game) const
{
    return game.state_hash() == m_recording.hash && scores_of(game) == m_recording.scores;
}

Playback::Playback(Recording recording) : m_recording(std::move(recording)), m_table(table_of(m_recording)) {}

Game Playback::new_game() const { return Game(m_table, m_recording.options); }

Input Playback::next()
{
    if (m_next_change < m_recording.changes.size() && m_recording.changes[m_next_change].step == m_step)
        m_held = m_recording.changes[m_next_change++].input;
    ++m_step;
    return m_held;
}

} // namespace carom::pinball
