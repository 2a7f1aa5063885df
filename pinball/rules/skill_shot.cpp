// The skill shot: one lane flashes while the ball waits and flies. The flippers move it. It is missed when the ball comes
// into another lane or strikes anything that is made to be struck; rollovers on the way there do not count.

#include "pinball/rules/rule.h"

#include <algorithm>

namespace carom::pinball {

namespace {

class SkillShot final : public Rule
{
public:
    explicit SkillShot(const SkillShotRule& rule) : m_rule(rule) {}

    void start_game(Desk&) override { m_made = 0; }

    void start_ball(Desk& desk) override
    {
        const auto& members = lanes(desk);
        m_lane = members.empty() ? 0 : static_cast<std::size_t>(desk.player.ball) % members.size();
        m_open = !members.empty();
        show(desk);
    }

    void on_press(Desk& desk, Side side) override
    {
        if (!m_open)
            return;
        const std::size_t count = lanes(desk).size();
        m_lane = (m_lane + (side == Side::Left ? count - 1 : 1)) % count;
        show(desk);
    }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (!m_open || event.element == none || !is_made(event))
            return;
        if (event.element == lanes(desk)[m_lane])
            pay(desk, event.element);
        else if (misses(desk, event.element))
        {
            m_open = false;
            show(desk);
        }
    }

    void add_to(Hash& hash) const override
    {
        hash.add(static_cast<int>(m_lane));
        hash.add(m_made);
        hash.add(m_open);
    }

private:
    [[nodiscard]] const std::vector<Index>& lanes(const Desk& desk) const { return desk.table().groups[m_rule.group].members; }

    [[nodiscard]] bool misses(const Desk& desk, Index element) const
    {
        const bool is_sensor = std::holds_alternative<Sensor>(desk.table().elements[element].part);
        return !is_sensor || desk.table().elements[element].group == m_rule.group;
    }

    void show(Desk& desk) const { desk.flashing = m_open ? lanes(desk)[m_lane] : none; }

    void pay(Desk& desk, Index lane)
    {
        const int points = m_rule.score + m_made++ * m_rule.increase;
        desk.add_score(points);
        desk.say("SKILL SHOT " + std::to_string(points), 6, 2.5f);
        desk.announce({.kind = EventKind::SkillShot, .element = lane, .value = points});
        m_open = false;
        show(desk);
    }

    SkillShotRule m_rule;
    std::size_t m_lane = 0;
    int m_made = 0;
    bool m_open = false;
};

} // namespace

RulePtr make_skill_shot(const SkillShotRule& rule) { return std::make_unique<SkillShot>(rule); }

} // namespace carom::pinball
