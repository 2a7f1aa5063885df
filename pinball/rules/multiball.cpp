// Multiball: hits of the target light the saucer; enough balls caught there while it is lit start it. The saucer gives
// its ball back each time, so that one ball is always enough to play on. During multiball the jackpots pay in turn.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

class Multiball final : public Rule
{
public:
    explicit Multiball(const MultiballRule& rule) : m_rule(rule) {}

    void start_game(Desk& desk) override
    {
        m_hits = 0;
        m_locks = 0;
        light_lock(desk, false);
        end(desk);
    }

    // A tilt may have ended the last ball in the middle of it.
    void start_ball(Desk& desk) override { end(desk); }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (desk.multiball)
            on_jackpot(desk, event);
        else if (event.element == m_rule.target && event.kind == EventKind::Hit)
            on_target(desk);
        else if (event.element == m_rule.saucer && event.kind == EventKind::Captured && desk.player.lock_is_lit)
            on_lock(desk);
    }

    void on_step(Desk& desk) override
    {
        if (desk.multiball && desk.balls_out() < 2)
            end(desk);
    }

    void add_to(Hash& hash) const override
    {
        hash.add(m_hits);
        hash.add(m_locks);
        hash.add(static_cast<int>(m_next_jackpot));
    }

private:
    void on_target(Desk& desk)
    {
        if (desk.player.lock_is_lit || ++m_hits < m_rule.hits)
            return;
        m_hits = 0;
        light_lock(desk, true);
        desk.say("LOCK IS LIT", 4, 2);
    }

    void on_lock(Desk& desk)
    {
        light_lock(desk, false);
        if (++m_locks < m_rule.locks)
            desk.say("BALL " + std::to_string(m_locks) + " LOCKED", 5, 2);
        else
            start(desk);
    }

    void start(Desk& desk)
    {
        m_locks = 0;
        desk.multiball = true;
        for (int i = 1; i < m_rule.balls; ++i)
            desk.serve(true);
        desk.saved_until = desk.now() + desk.steps(m_rule.ball_save);
        desk.say("CHAIN REACTION", 7, 3);
        desk.announce({.kind = EventKind::MultiballStarted, .element = m_rule.saucer, .value = m_rule.balls});
        m_next_jackpot = 0;
        show_jackpot(desk, LampState::Blink);
    }

    void end(Desk& desk)
    {
        desk.multiball = false;
        show_jackpot(desk, LampState::Off);
    }

    void on_jackpot(Desk& desk, const GameEvent& event)
    {
        if (m_rule.jackpots.empty() || event.element != m_rule.jackpots[m_next_jackpot] || !is_made(event))
            return;
        show_jackpot(desk, LampState::Off);
        m_next_jackpot = (m_next_jackpot + 1) % m_rule.jackpots.size();
        show_jackpot(desk, LampState::Blink);
        desk.add_score(m_rule.jackpot);
        desk.say("JACKPOT " + std::to_string(m_rule.jackpot), 7, 2);
        desk.announce({.kind = EventKind::Jackpot, .element = event.element, .value = m_rule.jackpot});
    }

    void light_lock(Desk& desk, bool lit)
    {
        desk.player.lock_is_lit = lit;
        desk.player.lamps[m_rule.saucer] = lit ? LampState::Blink : LampState::Off;
    }

    void show_jackpot(Desk& desk, LampState lamp)
    {
        if (m_next_jackpot < m_rule.jackpots.size())
            desk.player.lamps[m_rule.jackpots[m_next_jackpot]] = lamp;
    }

    MultiballRule m_rule;
    int m_hits = 0;
    int m_locks = 0;
    std::size_t m_next_jackpot = 0;
};

} // namespace

RulePtr make_multiball(const MultiballRule& rule) { return std::make_unique<Multiball>(rule); }

} // namespace carom::pinball
