// The replay: each player who reaches the score wins a game or a ball, once in a game.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

class Replay final : public Rule
{
public:
    explicit Replay(const ReplayRule& rule) : m_rule(rule) {}

    void start_game(Desk&) override { m_won = false; }

    void on_step(Desk& desk) override
    {
        if (m_won || desk.player.score < m_rule.score)
            return;
        m_won = true;
        ++(m_rule.wins_a_ball ? desk.player.extra_balls : desk.credits);
        desk.say(m_rule.wins_a_ball ? "REPLAY  EXTRA BALL" : "REPLAY  FREE GAME", 8, 3);
        desk.announce({.kind = EventKind::Replay, .value = m_rule.score});
    }

    void add_to(Hash& hash) const override { hash.add(m_won); }

private:
    ReplayRule m_rule;
    bool m_won = false;
};

} // namespace

RulePtr make_replay(const ReplayRule& rule) { return std::make_unique<Replay>(rule); }

} // namespace carom::pinball
