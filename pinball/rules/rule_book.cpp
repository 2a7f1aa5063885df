#include "pinball/rules/rule_book.h"

#include <algorithm>
#include <utility>

namespace carom::pinball {

namespace {

constexpr float count_interval = 0.06f; // s between two pieces of the bonus count
constexpr int count_pieces = 15;        // so that no bonus takes longer than a second

} // namespace

// The ball save comes last: it judges a drain after all the others have seen it.
RuleBook::RuleBook(const Table& table, const RuleOptions& options) : m_desk(table)
{
    const Rules& rules = table.rules;
    m_rules.push_back(make_groups(table));
    m_rules.push_back(make_scoring(table));
    if (rules.lanes)
        m_rules.push_back(make_lanes(table, *rules.lanes));
    if (rules.bank)
        m_rules.push_back(make_bank(*rules.bank));
    if (rules.skill_shot)
        m_rules.push_back(make_skill_shot(*rules.skill_shot));
    if (rules.combo)
        m_rules.push_back(make_combo(*rules.combo));
    if (rules.multiball)
        m_rules.push_back(make_multiball(*rules.multiball));
    m_rules.push_back(make_kickback(table, options.kickback));
    if (options.balls_at_once > 1)
        m_rules.push_back(make_more_balls(options.balls_at_once));
    m_rules.push_back(make_tilt(rules.tilt_warnings));
    if (options.ball_search && rules.ball_search > 0)
        m_rules.push_back(make_ball_search(rules.ball_search));
    if (rules.ball_save && options.ball_save)
        m_rules.push_back(make_ball_save(*rules.ball_save));
    m_desk.order_all(Command::Disable);
}

void RuleBook::step(std::int64_t step, const Presses& presses, std::span<const GameEvent> events, const Seen& seen)
{
    m_announced.clear();
    m_desk.begin_step(step, seen);
    press(presses);
    for (const GameEvent& event : events)
        hear(event);
    for (auto& rule : m_rules)
        rule->on_step(m_desk);
    if (m_desk.tilted && is_playing() && m_desk.balls_out() == 0)
        end_ball();
    if (m_desk.phase == Phase::Bonus)
        count_bonus();
    hear_announced();
}

void RuleBook::press(const Presses& presses)
{
    if (presses.start && (m_desk.phase == Phase::Attract || m_desk.phase == Phase::GameOver))
        start_game();
    else if (presses.start && m_desk.phase == Phase::Bonus)
        m_bonus_piece = m_bonus_left;
    if (!is_playing() || m_desk.tilted)
        return;
    for (auto& rule : m_rules)
    {
        if (presses.left)
            rule->on_press(m_desk, Side::Left);
        if (presses.right)
            rule->on_press(m_desk, Side::Right);
    }
}

void RuleBook::hear(const GameEvent& event)
{
    if (!is_playing())
        return;
    m_desk.ball_was_saved = false;
    if (!m_desk.tilted)
        for (auto& rule : m_rules)
            rule->on_event(m_desk, event);
    if (event.kind == EventKind::Drained)
    {
        if (!m_desk.ball_was_saved && m_desk.balls_out() == 0)
            end_ball();
    }
    else if (m_desk.phase == Phase::Ready && is_playfield_switch(m_desk.table(), event))
    {
        m_desk.phase = Phase::InPlay;
    }
}

// Rules hear one another, too: a complete group lights a letter.
void RuleBook::hear_announced()
{
    for (auto events = m_desk.take_announced(); !events.empty(); events = m_desk.take_announced())
        for (const GameEvent& event : events)
        {
            m_announced.push_back(event);
            hear(event);
        }
}

bool RuleBook::is_playing() const { return m_desk.phase == Phase::Ready || m_desk.phase == Phase::InPlay; }

int RuleBook::ball_save_steps() const
{
    return is_playing() ? static_cast<int>(std::max<std::int64_t>(0, m_desk.saved_until - m_desk.now())) : 0;
}

// --- The course of a game ------------------------------------------------------------------------------------------

void RuleBook::start_game()
{
    m_desk.score = 0;
    m_desk.ball = 0;
    m_desk.order_all(Command::Enable);
    for (auto& rule : m_rules)
        rule->start_game(m_desk);
    m_desk.announce({.kind = EventKind::GameStarted});
    start_ball();
}

void RuleBook::start_ball()
{
    ++m_desk.ball;
    m_desk.bonus = 0;
    m_desk.multiplier = 1;
    m_desk.phase = Phase::Ready;
    if (std::exchange(m_desk.tilted, false))
        m_desk.order_all(Command::Enable);
    for (auto& rule : m_rules)
        rule->start_ball(m_desk);
    m_desk.serve();
    m_desk.say("BALL " + std::to_string(m_desk.ball), 1, 2);
}

void RuleBook::end_ball()
{
    m_desk.announce({.kind = EventKind::BallEnded, .value = m_desk.ball});
    m_desk.phase = Phase::Bonus;
    m_desk.saved_until = 0;
    m_desk.flashing = none;
    m_bonus_left = std::int64_t{m_desk.bonus} * m_desk.multiplier;
    m_bonus_piece = (m_bonus_left / count_pieces / 10 + 1) * 10;
    m_next_count = std::max(m_desk.now() + m_desk.steps(4 * count_interval), m_desk.shaken_until);
    if (!m_desk.tilted)
        m_desk.say("BONUS " + std::to_string(m_desk.bonus) + " X" + std::to_string(m_desk.multiplier), 5, 2);
}

void RuleBook::count_bonus()
{
    if (m_desk.now() < m_next_count)
        return;
    m_next_count = m_desk.now() + m_desk.steps(count_interval);
    if (m_bonus_left == 0)
    {
        end_turn();
        return;
    }
    const std::int64_t piece = std::min(m_bonus_piece, m_bonus_left);
    m_bonus_left -= piece;
    m_desk.add_score(piece);
    m_desk.announce({.kind = EventKind::BonusCounted, .value = static_cast<int>(piece)});
}

void RuleBook::end_turn()
{
    if (m_desk.ball < m_desk.table().rules.balls)
    {
        start_ball();
        return;
    }
    m_desk.phase = Phase::GameOver;
    m_desk.order_all(Command::Disable);
    m_desk.announce({.kind = EventKind::GameEnded});
    m_desk.say("GAME OVER", 8, 5);
}

void RuleBook::add_to(Hash& hash) const
{
    m_desk.add_to(hash);
    hash.add(m_bonus_left);
    hash.add(m_bonus_piece);
    hash.add(m_next_count);
    for (const auto& rule : m_rules)
        rule->add_to(hash);
}

} // namespace carom::pinball
