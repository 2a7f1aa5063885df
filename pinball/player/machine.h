#pragma once

/// @file
/// The game with everything around it that lives as long as the program: its table file, its high scores, its player.

#include "pinball/autoplay/reflex.h"
#include "pinball/game/game.h"
#include "pinball/player/controls.h"
#include "pinball/player/effects.h"
#include "pinball/player/game_files.h"
#include "pinball/player/high_score_file.h"
#include "pinball/player/name_entry.h"
#include "pinball/player/step_times.h"
#include "pinball/player/table_art.h"
#include "pinball/player/table_watch.h"
#include "pinball/recording/recording.h"
#include "view/impact_story.h"
#include "view/substep_scrubber.h"

#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace carom::pinball {

class Machine
{
public:
    /// Throws std::runtime_error with the loader's sentences where the file is no table. keep_scores: on the disk.
    Machine(const std::string& file, std::uint64_t seed, bool autoplay, bool keep_scores);
    /// A name that is being written goes to the file as far as it has come.
    ~Machine();
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;

    void step(Input input);
    void restart();
    /// Plays a recorded game again instead of the player's; a sentence where that cannot be. What the buttons do then counts for nothing.
    [[nodiscard]] std::string watch(const std::filesystem::path& file);
    /// The player's last game, of this run of the program or of one before.
    [[nodiscard]] std::string watch_last();
    /// Back to the player's own table.
    void stop_watching();
    [[nodiscard]] bool is_watching() const { return m_playback.has_value(); }
    /// The watched game is over; came_out_the_same() says whether it came out as it was recorded.
    [[nodiscard]] bool has_watched() const { return m_playback && m_playback->is_over(); }
    [[nodiscard]] bool came_out_the_same() const { return m_came_out_the_same; }
    /// Changes with the table that is played.
    [[nodiscard]] std::uint64_t table_version() const { return m_table_version; }
    /// A game that nobody has played or that is over.
    [[nodiscard]] bool is_idle() const { return m_game.phase() == Phase::Attract || m_game.phase() == Phase::GameOver; }
    /// From now on, or no longer, a program plays.
    void play_by_itself(bool on);
    /// Looks whether the table file has changed. A good one is played at once: true; a bad one leaves the old table.
    bool poll_table();

    [[nodiscard]] const Game& game() const { return m_game; }
    [[nodiscard]] const Effects& effects() const { return m_effects; }
    [[nodiscard]] const TableArt& art() const { return m_art; }
    [[nodiscard]] const NameEntry& name_entry() const { return m_name_entry; }
    [[nodiscard]] NameEntry& name_entry() { return m_name_entry; }
    [[nodiscard]] const std::string& score_trouble() const
    {
        return m_score_trouble;
    } ///< a sentence, where scores, games or keys cannot be kept or read
    [[nodiscard]] const std::vector<std::string>& table_errors() const { return m_table_errors; }
    [[nodiscard]] const StepTimes& times() const { return m_times; }

    /// For the x-ray: keeps what happened within steps.
    void record_substeps(bool record);
    /// Fills the scrubber with the last step, where sub-steps are recorded.
    void look_into_step();
    Controls controls{};
    view::SubstepScrubber scrubber{};
    view::ImpactWatch impacts;
    BodyId selected{}; ///< whose story the x-ray tells
    /// Names a thing by its element.
    [[nodiscard]] view::ShapeNamer namer() const;

private:
    void begin(Table table, std::string text);
    /// Puts another game in place of this one, which it gives back; what was seen of it is forgotten.
    Game put(Game game);
    void forget_what_was_seen();
    [[nodiscard]] std::string watch(Recording recording);
    void step_watched();
    /// A game of its own for each time somebody presses start, recorded from its first step.
    void begin_game();
    /// Keeps what has been recorded of it.
    void end_game();
    void load_scores();
    /// Takes down the next name, where a score waits for one.
    void ask_for_name();
    void keep_score(int rank);
    void keep_named_score(); ///< the one whose name is being written
    void keep_scores();

    TableWatch m_watch;
    std::string m_table_text{};
    std::uint64_t m_table_version = 1;
    Random m_seeds;
    std::uint64_t m_seed;
    bool m_autoplay;
    bool m_record = false;
    std::optional<HighScoreFile> m_score_file{};
    std::optional<GameFiles> m_game_files{};
    std::optional<Recorder> m_recorder{};
    std::optional<Recording> m_last_game{};
    std::optional<Playback> m_playback{};
    std::optional<Game> m_own_game{}; ///< waits while another one is watched
    bool m_came_out_the_same = false;
    bool m_start_was_down = false;
    Game m_game;
    Effects m_effects;
    TableArt m_art;
    std::optional<ReflexPlayer> m_player{};
    NameEntry m_name_entry{};
    std::deque<GameEvent> m_unnamed{}; ///< scores that wait for a name
    std::string m_score_trouble{};
    std::vector<std::string> m_table_errors{};
    StepTimes m_times{};
};

} // namespace carom::pinball
