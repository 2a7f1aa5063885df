#include "pinball/rules/rule_book.h"

#include <algorithm>
#include <utility>

namespace carom::pinball {

namespace {

constexpr float count_interval = 0.06f; // s between two pieces of the bonus count
constexpr int count_pieces = 15;        // so that no bonus takes longer than a second
constexpr float match_time = 2;         // s
constexpr float match_interval = 0.1f;  // s

std::string two_digits(int number) { return {static_cast<char>('0' + number / 10), static_cast<char>('0' + number % 10)}; }

} // namespace

RuleBook::RuleBook(const Table& table, const RuleOptions& options)
    : m_table(&table), m_options(options), m_desk(table, options.seed)
{
    m_desk.credits = options.credits;
    m_seats.push_back(new_seat());
    m_desk.order_all(Command::Disable);
}

// The ball save comes last: it judges a drain after all the others have seen it.
RuleBook::Seat RuleBook::new_seat() const
{
    const Table& table = *m_table;
    const Rules& rules = table.rules;
    Seat seat{.player = m_desk.new_player()};
    const auto play = [&seat](RulePtr rule) { seat.rules.push_back(std::move(rule)); };
    play(make_groups(table));
    play(make_scoring(table));
    if (rules.lanes)
        play(make_lanes(table, *rules.lanes));
    if (rules.bank)
        play(make_bank(*rules.bank));
    if (rules.skill_shot)
        play(make_skill_shot(*rules.skill_shot));
    if (rules.combo)
        play(make_combo(*rules.combo));
    if (rules.multiball)
        play(make_multiball(*rules.multiball));
    if (rules.extra_ball)
        play(make_extra_ball(*rules.extra_ball));
    if (rules.replay)
        play(make_replay(*rules.replay));
    play(make_kickback(table, m_options.kickback));
    if (m_options.balls_at_once > 1)
        play(make_more_balls(m_options.balls_at_once));
    play(make_tilt(rules.tilt_warnings));
    if (m_options.ball_search && rules.ball_search > 0)
        play(make_ball_search(rules.ball_search));
    if (rules.ball_save && m_options.ball_save)
        play(make_ball_save(*rules.ball_save));
    return seat;
}

void RuleBook::step(std::int64_t step, const Presses& presses, std::span<const GameEvent> events, const Seen& seen)
{
    m_announced.clear();
    m_desk.begin_step(step, seen);
    press(presses);
    for (const GameEvent& event : events)
        hear(event);
    for (auto& rule : seat().rules)
        if (!m_desk.tilted || rule->works_tilted())
            rule->on_step(m_desk);
    if (m_desk.tilted && is_playing() && m_desk.balls_out() == 0)
        end_ball();
    if (m_desk.phase == Phase::Bonus)
        count_bonus();
    else if (m_desk.phase == Phase::Match)
        match();
    hear_announced();
}

void RuleBook::press(const Presses& presses)
{
    if (presses.start && (m_desk.phase == Phase::Attract || m_desk.phase == Phase::GameOver))
        start_game();
    else if (presses.start && m_desk.phase == Phase::Bonus)
        m_bonus_piece = m_bonus_left;
    else if (presses.start && may_join())
        join_game();
    if (!is_playing() || m_desk.tilted)
        return;
    for (auto& rule : seat().rules)
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
    for (auto& rule : seat().rules)
        if (!m_desk.tilted || rule->works_tilted())
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
    m_seats.clear();
    m_seats.push_back(new_seat());
    m_desk.player = m_seats.front().player;
    m_desk.players = 1;
    m_desk.player_up = 0;
    m_desk.credits = std::max(0, m_desk.credits - 1);
    m_desk.order_all(Command::Enable);
    m_desk.announce({.kind = EventKind::GameStarted});
    take_turn(0);
    start_ball();
}

// As long as everybody plays the first ball.
bool RuleBook::may_join() const { return is_playing() && m_desk.player.ball == 1 && m_desk.players < most_players; }

void RuleBook::join_game()
{
    m_seats.push_back(new_seat());
    ++m_desk.players;
    m_desk.credits = std::max(0, m_desk.credits - 1);
    m_desk.say(std::to_string(m_desk.players) + " PLAYERS", 7, 2);
    m_desk.announce({.kind = EventKind::PlayerJoined, .value = m_desk.players});
}

void RuleBook::take_turn(int player)
{
    seat().player = std::move(m_desk.player);
    m_desk.player_up = player;
    m_desk.player = std::move(seat().player);
    for (auto& rule : seat().rules)
        seat().has_begun ? rule->begin_turn(m_desk) : rule->start_game(m_desk);
    seat().has_begun = true;
    m_desk.announce({.kind = EventKind::TurnBegan, .value = player});
}

void RuleBook::start_ball()
{
    const bool again = m_desk.player.extra_balls > 0;
    if (again)
        --m_desk.player.extra_balls;
    else
        ++m_desk.player.ball;
    m_desk.player.bonus = 0;
    m_desk.player.multiplier = 1;
    m_desk.phase = Phase::Ready;
    for (auto& rule : seat().rules)
        rule->start_ball(m_desk);
    m_desk.serve();
    m_desk.say(m_desk.prefix() + (again ? "SHOOT AGAIN" : "BALL " + std::to_string(m_desk.player.ball)), again ? 6 : 1, 2);
}

void RuleBook::end_ball()
{
    m_desk.announce({.kind = EventKind::BallEnded, .value = m_desk.player.ball});
    m_desk.phase = Phase::Bonus;
    m_desk.saved_until = 0;
    m_desk.flashing = none;
    m_bonus_left = m_desk.player.bonus * m_desk.player.multiplier;
    m_bonus_piece = (m_bonus_left / count_pieces / 10 + 1) * 10;
    m_next_count = std::max(m_desk.now() + m_desk.steps(4 * count_interval), m_desk.shaken_until);
    if (!m_desk.tilted)
        m_desk.say("BONUS " + std::to_string(m_desk.player.bonus) + " X" + std::to_string(m_desk.player.multiplier), 5, 2);
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
    if (std::exchange(m_desk.tilted, false))
        m_desk.order_all(Command::Enable);
    if (m_desk.player.extra_balls > 0)
        return start_ball();
    const int next = (m_desk.player_up + 1) % m_desk.players;
    if (next == 0 && m_desk.player.ball >= m_table->rules.balls)
        return m_table->rules.match ? begin_match() : end_game();
    if (m_desk.players > 1)
        take_turn(next);
    start_ball();
}

std::int64_t RuleBook::score(int player) const
{
    return player == m_desk.player_up ? m_desk.player.score : m_seats[static_cast<std::size_t>(player)].player.score;
}

// --- The match -------------------------------------------------------------------------------------------------------

void RuleBook::begin_match()
{
    m_desk.phase = Phase::Match;
    m_match_number = 10 * static_cast<int>(m_desk.random.bits() % 10);
    m_match_ends = m_desk.now() + m_desk.steps(match_time);
}

// Numbers run past until the one that was drawn stands.
void RuleBook::match()
{
    const std::int64_t left = m_match_ends - m_desk.now();
    if (left > 0)
    {
        if (left % m_desk.steps(match_interval) == 0)
            m_desk.say("MATCH " + two_digits(static_cast<int>(left / m_desk.steps(match_interval) * 30 % 100)), 8,
                       match_interval);
        return;
    }
    int won = 0;
    for (int player = 0; player < m_desk.players; ++player)
        won += score(player) % 100 == m_match_number ? 1 : 0;
    m_desk.credits += won;
    m_desk.say("MATCH " + two_digits(m_match_number) + (won > 0 ? "  FREE GAME" : ""), 9, 4);
    m_desk.announce({.kind = EventKind::Match, .speed = won > 0 ? 1.0f : 0.0f, .value = m_match_number});
    end_game();
}

void RuleBook::end_game()
{
    m_desk.phase = Phase::GameOver;
    m_desk.order_all(Command::Disable);
    m_desk.announce({.kind = EventKind::GameEnded});
    m_desk.say("GAME OVER", 8, 5);
}

void RuleBook::add_to(Hash& hash) const
{
    m_desk.add_to(hash);
    for (const std::int64_t value : {m_bonus_left, m_bonus_piece, m_next_count, m_match_ends})
        hash.add(value);
    hash.add(m_match_number);
    for (std::size_t i = 0; i < m_seats.size(); ++i)
    {
        if (static_cast<int>(i) != m_desk.player_up) // who plays is on the desk
            m_seats[i].player.add_to(hash);
        hash.add(m_seats[i].has_begun);
        for (const auto& rule : m_seats[i].rules)
            rule->add_to(hash);
    }
}

} // namespace carom::pinball
