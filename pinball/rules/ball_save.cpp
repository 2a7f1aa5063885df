// The ball save: from the first switch of the playfield its light is on for a while, and a ball that drains then, or in the
// grace after it, is served again. Each ball is saved a limited number of times; in a multiball every one is, for its time.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

class BallSave final : public Rule
{
public:
    explicit BallSave(const BallSaveRule& rule) : m_rule(rule) {}

    void start_ball(Desk& desk) override
    {
        m_saves_left = m_rule.per_ball;
        m_started = false;
        desk.saved_until = 0;
    }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (event.kind == EventKind::Drained)
            judge(desk);
        else if (!m_started && m_saves_left > 0 && is_playfield_switch(desk.table(), event))
            start(desk);
    }

    void add_to(Hash& hash) const override
    {
        hash.add(m_saves_left);
        hash.add(m_started);
    }

private:
    void start(Desk& desk)
    {
        m_started = true;
        desk.saved_until = desk.now() + desk.steps(m_rule.time);
    }

    void judge(Desk& desk)
    {
        const bool in_time = desk.now() <= desk.saved_until + desk.steps(m_rule.grace) && desk.saved_until > 0;
        if (!in_time || (!desk.multiball && m_saves_left == 0))
            return;
        if (!desk.multiball && --m_saves_left == 0)
            desk.saved_until = 0;
        desk.ball_was_saved = true;
        desk.serve(desk.multiball);
        desk.say("BALL SAVED", 6, 2);
        desk.announce({.kind = EventKind::BallSaved});
    }

    BallSaveRule m_rule;
    int m_saves_left = 0;
    bool m_started = false;
};

} // namespace

RulePtr make_ball_save(const BallSaveRule& rule) { return std::make_unique<BallSave>(rule); }

} // namespace carom::pinball
