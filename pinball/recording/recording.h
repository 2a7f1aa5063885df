#pragma once

/// @file
/// A game as its inputs: with the table and the seed they are all that is needed to play it again, bit for bit, at any speed.

#include "pinball/game/game.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace carom::pinball {

struct Recording
{
    /// The buttons from a step on, until the next change. In the file [step, bits], with a third number where the rod is held back.
    struct Change
    {
        std::int64_t step = 0;
        Input input{};
        friend bool operator==(const Change&, const Change&) = default;
    };

    std::string table_text{}; ///< the whole table file
    Options options{};
    std::vector<Change> changes{};
    std::int64_t steps = 0;             ///< that were played
    std::vector<std::int64_t> scores{}; ///< at the end, by player
    std::uint64_t hash = 0;             ///< Game::state_hash at the end

    [[nodiscard]] std::string to_json() const;
    /// Writes the file; a sentence where that cannot be done, else nothing.
    [[nodiscard]] std::string save(const std::filesystem::path& file) const;
};

/// A recording, or the sentence that says why there is none.
struct LoadedRecording
{
    std::optional<Recording> recording{};
    std::string trouble{};
};
[[nodiscard]] LoadedRecording read_recording(std::string_view json);
[[nodiscard]] LoadedRecording load_recording(const std::filesystem::path& file);

/// By player.
[[nodiscard]] std::vector<std::int64_t> scores_of(const Game& game);

/// Writes down a game as it is played, from its first step on.
class Recorder
{
public:
    Recorder(std::string table_text, const Options& options);

    /// Before each step of the game.
    void note(const Input& input);
    /// The game as far as it has been played.
    [[nodiscard]] Recording recording(const Game& game) const;

private:
    Recording m_recording;
    Input m_held{};
};

/// Plays a recording again.
class Playback
{
public:
    /// Throws std::runtime_error with the loader's sentences where the recorded table is none.
    explicit Playback(Recording recording);

    [[nodiscard]] const Recording& recording() const { return m_recording; }
    /// A new game, before its first step.
    [[nodiscard]] Game new_game() const;
    [[nodiscard]] bool is_over() const { return m_step == m_recording.steps; }
    /// The buttons of the next step.
    [[nodiscard]] Input next();
    /// Whether the game, played to its end, came out as it was recorded.
    [[nodiscard]] bool came_out_the_same(const Game& game) const;

private:
    Recording m_recording;
    Table m_table;
    std::int64_t m_step = 0;
    std::size_t m_next_change = 0;
    Input m_held{};
};

} // namespace carom::pinball
