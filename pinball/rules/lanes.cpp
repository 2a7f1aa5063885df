// The top lanes: complete, they raise the bonus multiplier and light the kickback again.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

class Lanes final : public Rule
{
public:
    explicit Lanes(const LaneRule& rule) : m_rule(rule) {}

    void start_ball(Desk& desk) override { desk.player.multiplier = 1; }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (event.kind != EventKind::GroupCompleted || static_cast<Index>(event.value) != m_rule.group)
            return;
        if (desk.player.multiplier < desk.table().rules.bonus_multiplier_max)
            ++desk.player.multiplier;
        desk.say("BONUS X" + std::to_string(desk.player.multiplier), 4, 2);
        if (m_rule.kicker != none)
            desk.order(m_rule.kicker, Command::Light);
    }

private:
    LaneRule m_rule;
};

} // namespace

RulePtr make_lanes(const Table&, const LaneRule& rule) { return std::make_unique<Lanes>(rule); }

} // namespace carom::pinball
