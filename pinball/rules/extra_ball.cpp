// The extra ball: a group that was completed often enough lights it; the shot wins it. It is played before anybody else's turn.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

class ExtraBall final : public Rule
{
public:
    explicit ExtraBall(const ExtraBallRule& rule) : m_rule(rule) {}

    void start_game(Desk&) override
    {
        m_completed = 0;
        m_given = 0;
    }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (event.kind == EventKind::GroupCompleted && static_cast<Index>(event.value) == m_rule.group)
            count(desk);
        else if (desk.player.extra_ball_is_lit && event.element == m_rule.shot && is_made(event))
            give(desk);
    }

    void add_to(Hash& hash) const override
    {
        hash.add(m_completed);
        hash.add(m_given);
    }

private:
    void count(Desk& desk)
    {
        if (desk.player.extra_ball_is_lit || m_given == m_rule.per_game || ++m_completed < m_rule.completions)
            return;
        m_completed = 0;
        desk.player.extra_ball_is_lit = true;
        desk.say("EXTRA BALL IS LIT", 6, 2.5f);
    }

    void give(Desk& desk)
    {
        desk.player.extra_ball_is_lit = false;
        ++m_given;
        ++desk.player.extra_balls;
        desk.say("EXTRA BALL", 8, 3);
        desk.announce({.kind = EventKind::ExtraBall, .element = m_rule.shot});
    }

    ExtraBallRule m_rule;
    int m_completed = 0;
    int m_given = 0;
};

} // namespace

RulePtr make_extra_ball(const ExtraBallRule& rule) { return std::make_unique<ExtraBall>(rule); }

} // namespace carom::pinball
