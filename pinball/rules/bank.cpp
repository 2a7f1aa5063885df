// The bank of drop targets spells a word, a letter for each time it is complete.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

class Bank final : public Rule
{
public:
    explicit Bank(const BankRule& rule) : m_rule(rule) {}

    void start_game(Desk& desk) override { desk.player.letters = 0; }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (event.kind != EventKind::GroupCompleted || static_cast<Index>(event.value) != m_rule.group)
            return;
        const int length = static_cast<int>(m_rule.letters.size());
        desk.player.letters = desk.player.letters == length ? 1 : desk.player.letters + 1;
        desk.announce({.kind = EventKind::LetterLit, .element = event.element, .value = desk.player.letters});
        desk.say(m_rule.letters.substr(0, static_cast<std::size_t>(desk.player.letters)), 4, 2);
        if (desk.player.letters == length)
        {
            desk.add_score(m_rule.score);
            desk.say(m_rule.letters + " COMPLETE", 5, 3);
        }
    }

private:
    BankRule m_rule;
};

} // namespace

RulePtr make_bank(const BankRule& rule) { return std::make_unique<Bank>(rule); }

} // namespace carom::pinball
