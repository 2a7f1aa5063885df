#include "pinball/recording/recording.h"

#include "pinball/table/loader.h"

#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace carom::pinball {

namespace {

using Json = nlohmann::ordered_json;

constexpr int newest_version = 1;
constexpr std::int64_t most_steps = 100'000'000;

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

Options options_of(const Json& json)
{
    return {.seed = number_of(json.at("seed").get<std::string>()),
            .ball_save = json.at("ball_save").get<bool>(),
            .kickback = json.at("kickback").get<bool>(),
            .ball_search = json.at("ball_search").get<bool>(),
            .credits = json.at("credits").get<int>(),
            .balls_at_once = json.at("balls_at_once").get<int>()};
}

Recording recording_of(const Json& json)
{
    if (json.value("format", "") != "pinball-game")
        throw std::runtime_error("its \"format\" is not \"pinball-game\"");
    if (const int version = json.at("version").get<int>(); version > newest_version)
        throw std::runtime_error("its version is " + std::to_string(version) + ", and this program reads version " +
                                 std::to_string(newest_version));
    Recording recording{.table_text = json.at("table").get<std::string>(),
                        .options = options_of(json.at("options")),
                        .steps = json.at("steps").get<std::int64_t>(),
                        .scores = json.at("scores").get<std::vector<std::int64_t>>(),
                        .hash = number_of(json.at("hash").get<std::string>())};
    if (recording.steps < 0 || recording.steps > most_steps)
        throw std::runtime_error("\"steps\" must be between 0 and " + std::to_string(most_steps));
    std::int64_t last = -1;
    for (const Json& change : json.at("changes"))
    {
        const auto step = change.at(0).get<std::int64_t>();
        if (step <= last || step >= recording.steps)
            throw std::runtime_error("\"changes\" must ascend and lie within the steps, but one is at step " +
                                     std::to_string(step));
        Input input = input_of(change.at(1).get<int>());
        if (change.size() > 2)
            input.rod = change.at(2).get<std::uint8_t>();
        recording.changes.push_back({step, input});
        last = step;
    }
    return recording;
}

Table table_of(const Recording& recording)
{
    LoadResult result = load_table(recording.table_text);
    if (result.table)
        return std::move(*result.table);
    std::string text = "the recorded table is none:";
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
    return json.dump() + "\n";
}

std::string Recording::save(const std::filesystem::path& file) const
{
    std::ofstream out(file, std::ios::binary);
    out << to_json();
    out.close();
    return out ? std::string() : file.string() + ": the game cannot be written there";
}

LoadedRecording read_recording(std::string_view json)
{
    try
    {
        return {.recording = recording_of(Json::parse(json))};
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
    Recording whole = m_recording;
    for (int player = 0; player < game.players(); ++player)
        whole.scores.push_back(game.score(player));
    whole.hash = game.state_hash();
    return whole;
}

// --- Playback --------------------------------------------------------------------------------------------------------

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
