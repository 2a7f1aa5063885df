#pragma once

/// @file
/// State that the rules share: the score, the state of the ball, lamps and messages, and the tray of orders to the table.

#include "pinball/elements/device.h"
#include "pinball/elements/random.h"
#include "pinball/rules/show.h"
#include "pinball/table/table.h"

#include <string>
#include <vector>

namespace carom::pinball {

struct Order
{
    Index element = none;
    Command command = Command::Raise;
};

/// The state of one player, which waits while another one plays.
struct Player
{
    std::int64_t score = 0;
    int ball = 0;           ///< from 1; 0 before the first
    std::int64_t bonus = 0; ///< of the present ball
    int multiplier = 1;     ///< of that
    int extra_balls = 0;    ///< won and not yet played
    int letters = 0;
    int bumper_level = 0;
    bool extra_ball_is_lit = false;
    bool lock_is_lit = false;
    std::vector<LampState> lamps{};
    std::vector<bool> armed{}; ///< kickers, by element

    void add_to(Hash& hash) const;
};

/// The machine's knowledge of its balls and of the player's hands in a step.
struct Seen
{
    int balls_in_play = 0;
    bool all_known = true; ///< each is held, or lies before the plunger
    bool flipper_is_held = false;
};

class Desk
{
public:
    Desk(const Table& table, std::uint64_t seed);
    /// One at the start of a game.
    [[nodiscard]] Player new_player() const;
    /// "PLAYER 2 " where several play, else nothing.
    [[nodiscard]] std::string prefix() const;

    [[nodiscard]] const Table& table() const { return *m_table; }
    [[nodiscard]] std::int64_t now() const { return m_now; }
    [[nodiscard]] std::int64_t steps(float seconds) const;

    void add_score(std::int64_t points) { player.score += points; }
    /// Lines shown for as long as they last; the highest priority wins.
    void say(std::string text, int priority, float seconds);
    /// An event of the rules: all rules hear it, and so does whoever watches the game.
    void announce(GameEvent event) { m_announced.push_back(event); }
    void order(Index element, Command command);
    void order_all(Command command); ///< to everything that takes part in the game
    /// Another ball before the plunger, as soon as there is room.
    void serve(bool launch_it = false);

    void begin_step(std::int64_t step, const Seen& seen);
    [[nodiscard]] std::vector<GameEvent> take_announced();
    [[nodiscard]] std::vector<Order> take_orders();
    void ball_served() { --to_serve; }
    [[nodiscard]] const std::vector<Message>& messages() const { return m_messages; }
    /// Balls on the table or on their way to it.
    [[nodiscard]] int balls_out() const { return m_balls_in_play + to_serve; }
    void add_to(Hash& hash) const;

    Phase phase = Phase::Attract;
    Player player{};   ///< who plays now
    int players = 1;   ///< in this game
    int player_up = 0; ///< who of them, from 0
    int credits = 0;   ///< games won and not yet played
    int to_serve = 0;
    int to_launch = 0;            ///< of them, that the machine launches by itself
    std::int64_t saved_until = 0; ///< step until which the ball save is lit
    bool ball_was_saved = false;  ///< of the drain that is being judged
    bool tilted = false;          ///< until the ball has drained
    std::int64_t shaken_until = 0;
    bool knows_all_balls = true;
    bool flipper_is_held = false;
    bool recalls = false; ///< wants the balls on the table written off
    bool multiball = false;
    Index flashing = none; ///< the skill shot
    Random random;

private:
    const Table* m_table;
    std::int64_t m_now = 0;
    int m_balls_in_play = 0;
    std::vector<Message> m_messages{};
    std::vector<GameEvent> m_announced{};
    std::vector<Order> m_orders{};
};

/// A switch of the playfield closed: anything but the plunger's lane, walls and the drain.
[[nodiscard]] bool is_playfield_switch(const Table& table, const GameEvent& event);
/// An element was made: a rollover crossed, a target hit, a hole entered, a shot of a combo.
[[nodiscard]] bool is_made(const GameEvent& event);

} // namespace carom::pinball
