#pragma once

/// @file
/// The course of a game, and the rules that play in it.

#include "pinball/rules/rule.h"

#include <span>
#include <vector>

namespace carom::pinball {

/// Buttons that went down in this step.
struct Presses
{
    bool left = false;
    bool right = false;
    bool start = false;
};

struct RuleOptions
{
    std::uint64_t seed = 1; ///< of the number that the match draws
    bool ball_save = true;
    bool kickback = true;
    bool ball_search = true;
    int credits = 0;       ///< games won before
    int balls_at_once = 1; ///< kept in play whatever the table's rules
};

class RuleBook
{
public:
    /// The table must outlive the rules.
    RuleBook(const Table& table, const RuleOptions& options = {});

    /// Hears what happened in a step. The orders to the table are left on the desk.
    void step(std::int64_t step, const Presses& presses, std::span<const GameEvent> events, const Seen& seen);

    [[nodiscard]] Desk& desk() { return m_desk; }
    [[nodiscard]] const Desk& desk() const { return m_desk; }
    /// The rules' own reports of the last step.
    [[nodiscard]] const std::vector<GameEvent>& announced() const { return m_announced; }
    static constexpr int most_players = 4;
    /// The score of a player of this game, from 0.
    [[nodiscard]] std::int64_t score(int player) const;
    [[nodiscard]] int ball_save_steps() const;
    void add_to(Hash& hash) const;

private:
    void press(const Presses& presses);
    void hear(const GameEvent& event);
    void hear_announced();
    void start_game();
    void join_game();
    [[nodiscard]] bool may_join() const;
    void take_turn(int player);
    void start_ball();
    void end_ball();
    void count_bonus();
    void end_turn();
    void begin_match();
    void match();
    void end_game();
    [[nodiscard]] bool is_playing() const;

    /// Each player has a state of all rules.
    struct Seat
    {
        Player player{}; ///< while another one plays
        std::vector<RulePtr> rules{};
        bool has_begun = false;
    };
    [[nodiscard]] Seat new_seat() const;
    [[nodiscard]] Seat& seat() { return m_seats[static_cast<std::size_t>(m_desk.player_up)]; }

    const Table* m_table;
    RuleOptions m_options;
    Desk m_desk;
    std::vector<Seat> m_seats{};
    std::vector<GameEvent> m_announced{};
    std::int64_t m_bonus_left = 0;
    std::int64_t m_bonus_piece = 0;
    std::int64_t m_next_count = 0;
    std::int64_t m_match_ends = 0;
    int m_match_number = 0;
};

} // namespace carom::pinball
