#pragma once

/// @file
/// One game of pinball: a table that is stepped with inputs. No window, no sound, no clock: the same table, seed and
/// inputs give the same game, bit for bit.

#include "carom/scene.h"
#include "pinball/elements/cabinet.h"
#include "pinball/elements/event.h"
#include "pinball/elements/state.h"
#include "pinball/rules/high_scores.h"
#include "pinball/rules/show.h"
#include "pinball/table/table.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

namespace carom::pinball {

/// The buttons, as held during one step.
struct Input
{
    bool left = false;
    bool right = false;
    bool plunger = false; ///< held: pulls the rod; let go: releases it
    bool start = false;   ///< pressed: starts a game when none is on, adds a player during the first ball; skips the bonus count
    bool nudge_left = false;  ///< pressed: a slap on the left side; the cabinet moves to the right
    bool nudge_right = false; ///< pressed: a slap on the right side
    bool nudge_up = false;    ///< pressed: a push at the front, up the table
    std::uint8_t rod = 0;     ///< how far a hand holds the rod back, in 255ths of its stroke: a stick's plunger

    friend bool operator==(Input, Input) = default;
};

/// The buttons from a time of the step on, until the next change.
struct InputChange
{
    double time = 0; ///< s since the step began
    Input input{};
};

struct Options
{
    std::uint64_t seed = 1;
    bool ball_save = true;
    bool kickback = true;
    bool ball_search = true;
    int credits = 0;       ///< games won before
    int balls_at_once = 1; ///< kept in play whatever the table's rules; with more than one no ball is the last
};

class Game
{
public:
    explicit Game(Table table, const Options& options = {});
    ~Game();
    Game(Game&&) noexcept;
    Game& operator=(Game&&) noexcept;

    /// One step of Physics::step (by default 1 ms), with the buttons as they are held all through it.
    void step(const Input& input);
    /// One step in which the buttons change; up to the first change they stay as they were. For tables with long steps: flippers
    /// and plunger feel every millisecond. Refuses times (carom::Error) that go back or lie outside of the step.
    void step_through(std::span<const InputChange> changes);
    /// Back to the first step, with the same seed; high scores and games won stay.
    void restart();

    [[nodiscard]] const Table& table() const;
    [[nodiscard]] std::int64_t step_count() const;

    [[nodiscard]] Phase phase() const;
    [[nodiscard]] int ball_number() const; ///< from 1; 0 in attract
    [[nodiscard]] int balls_per_game() const;
    [[nodiscard]] int balls_served() const;   ///< since the first step, saved ones included
    [[nodiscard]] std::int64_t score() const; ///< of whose turn it is, or was last
    [[nodiscard]] std::int64_t score(int player) const;
    [[nodiscard]] int players() const;        ///< in this game, 1 to 4
    [[nodiscard]] int player_up() const;      ///< whose turn it is, from 0
    [[nodiscard]] int extra_balls() const;    ///< that wait for this player
    [[nodiscard]] int credits() const;        ///< games won and not yet played
    [[nodiscard]] std::int64_t bonus() const; ///< not yet multiplied
    [[nodiscard]] int bonus_multiplier() const;
    [[nodiscard]] int bumper_level() const;    ///< of this player, from 0
    [[nodiscard]] int letters() const;         ///< lit ones of the bank rule's word
    [[nodiscard]] int ball_save_steps() const; ///< left, 0 when the light is out
    [[nodiscard]] bool tilted() const;         ///< until the bonus of that ball would have been counted

    /// The state of any element: that of a Light itself; for every other one, the state that a light on it would show.
    [[nodiscard]] LampState lamp(Index element) const;
    /// The message that shows now; empty when there is none.
    [[nodiscard]] std::string_view message() const;
    [[nodiscard]] std::span<const Message> messages() const;

    [[nodiscard]] const ElementState& element(Index element) const;
    /// In serial order: captive ones first.
    [[nodiscard]] const std::vector<BallState>& balls() const;
    /// The events of the last step, in order.
    [[nodiscard]] std::span<const GameEvent> events() const;

    /// How it stands, and the tilt bob in it.
    [[nodiscard]] const Cabinet& cabinet() const;
    /// For queries and drawing.
    [[nodiscard]] const Scene& scene() const;
    void record_substeps(bool record);

    /// Over the whole state: scene, elements, rules and random numbers. High scores are not in it.
    [[nodiscard]] std::uint64_t state_hash() const;

    [[nodiscard]] const HighScores& high_scores() const;
    void set_high_scores(HighScores scores);
    /// The places that the game that just ended has won, by player: from 0, or -1 where a score is not among the best.
    [[nodiscard]] std::span<const int> last_ranks() const;
    void rename_score(int rank, std::string_view name);

private:
    struct State;
    std::unique_ptr<State> m_state;
};

} // namespace carom::pinball
