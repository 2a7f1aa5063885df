// Combos: different shots in quick succession pay more with each link of the chain. A shot is what a flipper made: the ball must have
// been on one since its last shot. So a plunge that runs round the orbit is none.

#include "pinball/rules/rule.h"

#include <algorithm>

namespace carom::pinball {

namespace {

class Combo final : public Rule
{
public:
    explicit Combo(const ComboRule& rule) : m_rule(rule) {}

    void start_ball(Desk&) override
    {
        m_chain = 0;
        m_flipped.clear();
    }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (is_flip(desk, event) && !was_flipped(event.ball))
            m_flipped.push_back(event.ball);
        if (!is_made(event) || std::ranges::find(m_rule.shots, event.element) == m_rule.shots.end())
            return;
        if (std::erase(m_flipped, event.ball) == 0)
            return;
        const bool in_time = m_chain > 0 && desk.now() <= m_until;
        // The same switch twice is a rattle, not a combo.
        if (in_time && event.element == m_last)
            return;
        m_chain = in_time ? std::min(m_chain + 1, m_rule.max) : 1;
        m_last = event.element;
        m_until = desk.now() + desk.steps(m_rule.window);
        if (m_chain < 2)
            return;
        desk.add_score(std::int64_t{m_rule.score} * m_chain);
        desk.say("COMBO X" + std::to_string(m_chain), 3, 1.5f);
        desk.announce({.kind = EventKind::Combo, .element = event.element, .value = m_chain});
    }

    void add_to(Hash& hash) const override
    {
        hash.add(m_chain);
        hash.add(m_until);
        hash.add(m_last);
        for (const int ball : m_flipped)
            hash.add(ball);
    }

private:
    [[nodiscard]] static bool is_flip(const Desk& desk, const GameEvent& event)
    {
        return event.kind == EventKind::Impact && event.element != none &&
               std::holds_alternative<Flipper>(desk.table().elements[event.element].part);
    }
    [[nodiscard]] bool was_flipped(int ball) const { return std::ranges::find(m_flipped, ball) != m_flipped.end(); }

    ComboRule m_rule;
    int m_chain = 0;
    std::int64_t m_until = 0;
    Index m_last = none;
    std::vector<int> m_flipped{}; ///< balls that were on a flipper since their last shot
};

} // namespace

RulePtr make_combo(const ComboRule& rule) { return std::make_unique<Combo>(rule); }

} // namespace carom::pinball
