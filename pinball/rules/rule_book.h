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
    bool ball_save = true;
    bool kickback = true;
    bool ball_search = true;
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
    /// What the rules themselves reported in the last step.
    [[nodiscard]] const std::vector<GameEvent>& announced() const { return m_announced; }
    [[nodiscard]] int ball_save_steps() const;
    void add_to(Hash& hash) const;

private:
    void press(const Presses& presses);
    void hear(const GameEvent& event);
    void hear_announced();
    void start_game();
    void start_ball();
    void end_ball();
    void count_bonus();
    void end_turn();
    [[nodiscard]] bool is_playing() const;

    Desk m_desk;
    std::vector<RulePtr> m_rules{};
    std::vector<GameEvent> m_announced{};
    std::int64_t m_bonus_left = 0;
    std::int64_t m_bonus_piece = 0;
    std::int64_t m_next_count = 0;
};

} // namespace carom::pinball
