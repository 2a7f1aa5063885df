#include "pinball/rules/desk.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::pinball {

Desk::Desk(const Table& table, std::uint64_t seed) : random(seed), m_table(&table) { player = new_player(); }

Player Desk::new_player() const
{
    Player fresh;
    fresh.lamps.assign(m_table->elements.size(), LampState::Off);
    fresh.armed.assign(m_table->elements.size(), false);
    return fresh;
}

std::string Desk::prefix() const { return players > 1 ? "PLAYER " + std::to_string(player_up + 1) + " " : ""; }

void Desk::order(Index element, Command command)
{
    if (command == Command::Light || command == Command::Unlight)
        player.armed[element] = command == Command::Light;
    m_orders.push_back({element, command});
}

std::int64_t Desk::steps(float seconds) const { return std::lround(seconds / m_table->physics.step); }

void Desk::say(std::string text, int priority, float seconds)
{
    m_messages.push_back({std::move(text), priority, m_now + steps(seconds)});
}

void Desk::order_all(Command command)
{
    for (Index i = 0; i < m_table->elements.size(); ++i)
        if (m_table->elements[i].enabled)
            order(i, command);
}

void Desk::serve(bool launch_it)
{
    ++to_serve;
    to_launch += launch_it ? 1 : 0;
}

void Desk::begin_step(std::int64_t step, const Seen& seen)
{
    m_now = step;
    m_balls_in_play = seen.balls_in_play;
    knows_all_balls = seen.all_known;
    flipper_is_held = seen.flipper_is_held;
    std::erase_if(m_messages, [step](const Message& message) { return message.until < step; });
}

std::vector<GameEvent> Desk::take_announced() { return std::exchange(m_announced, {}); }

std::vector<Order> Desk::take_orders() { return std::exchange(m_orders, {}); }

void Player::add_to(Hash& hash) const
{
    for (const int value : {ball, multiplier, extra_balls, letters, bumper_level})
        hash.add(value);
    hash.add(score);
    hash.add(bonus);
    hash.add(extra_ball_is_lit);
    hash.add(lock_is_lit);
    for (const LampState lamp : lamps)
        hash.add(static_cast<int>(lamp));
    for (const bool is_armed : armed)
        hash.add(is_armed);
}

void Desk::add_to(Hash& hash) const
{
    for (const int value : {static_cast<int>(phase), players, player_up, credits, to_serve, to_launch})
        hash.add(value);
    player.add_to(hash);
    hash.add(random.state());
    hash.add(saved_until);
    hash.add(tilted);
    hash.add(shaken_until);
    hash.add(multiball);
    hash.add(flashing);
}

bool is_made(const GameEvent& event)
{
    using enum EventKind;
    return event.kind == Entered || event.kind == Hit || event.kind == Fell || event.kind == Captured || event.kind == Fired;
}

bool is_playfield_switch(const Table& table, const GameEvent& event)
{
    if (!is_made(event) && event.kind != EventKind::Passed && event.kind != EventKind::Spun)
        return false;
    for (const auto& element : table.elements)
        if (const auto* plunger = std::get_if<Plunger>(&element.part); plunger && plunger->lane == event.element)
            return false;
    return true;
}

} // namespace carom::pinball
