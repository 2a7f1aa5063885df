// Kickbacks work once for each time they are lit. Those lit in the table are lit again when a game starts.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

class Kickback final : public Rule
{
public:
    explicit Kickback(bool on) : m_on(on) {}

    void start_game(Desk& desk) override
    {
        const auto& elements = desk.table().elements;
        for (Index i = 0; i < elements.size(); ++i)
            if (const auto* kicker = std::get_if<Kicker>(&elements[i].part))
                desk.order(i, m_on && kicker->lit ? Command::Light : Command::Unlight);
    }

    void begin_turn(Desk& desk) override
    {
        const auto& elements = desk.table().elements;
        for (Index i = 0; i < elements.size(); ++i)
            if (std::holds_alternative<Kicker>(elements[i].part))
                desk.order(i, desk.player.armed[i] ? Command::Light : Command::Unlight);
    }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (event.kind != EventKind::Fired || !std::holds_alternative<Kicker>(desk.table().elements[event.element].part))
            return;
        desk.order(event.element, Command::Unlight);
        desk.say("KICKBACK", 3, 1.5f);
    }

private:
    bool m_on;
};

} // namespace

RulePtr make_kickback(const Table&, bool on) { return std::make_unique<Kickback>(on); }

} // namespace carom::pinball
