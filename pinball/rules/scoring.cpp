// The pay of each element: its own score, bumpers by their level, the spinner more for a while after its trigger, the bash
// target by how hard it was hit. Every paying switch also counts towards the end-of-ball bonus.

#include "pinball/rules/rule.h"

#include <algorithm>

namespace carom::pinball {

namespace {

class Scoring final : public Rule
{
public:
    void start_game(Desk& desk) override
    {
        m_bumper_hits = 0;
        m_spinner_until = 0;
        desk.player.bumper_level = 0;
    }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (event.element == none || (!is_made(event) && event.kind != EventKind::Spun))
            return;
        watch_trigger(desk, event);
        const std::int64_t points = worth(desk, event);
        if (points == 0)
            return;
        desk.add_score(points);
        desk.player.bonus += desk.table().rules.bonus_per_switch;
    }

    void add_to(Hash& hash) const override
    {
        hash.add(m_bumper_hits);
        hash.add(m_spinner_until);
    }

private:
    [[nodiscard]] std::int64_t worth(Desk& desk, const GameEvent& event)
    {
        const Element& element = desk.table().elements[event.element];
        if (std::holds_alternative<Bumper>(element.part) && desk.table().rules.bumpers)
            return bumper(desk, *desk.table().rules.bumpers, event);
        if (std::holds_alternative<Spinner>(element.part))
            return std::int64_t{element.score} * spinner_factor(desk, event.element);
        if (const auto* target = std::get_if<SprungTarget>(&element.part))
            return std::int64_t{element.score} * grade(event.impulse, target->min_impulse);
        return element.score;
    }

    // A hit of three times the least impulse is a good one, of six times a great one.
    [[nodiscard]] static int grade(float impulse, float least) { return impulse >= 6 * least ? 3 : impulse >= 3 * least ? 2 : 1; }

    [[nodiscard]] std::int64_t bumper(Desk& desk, const BumperRule& rule, const GameEvent& event)
    {
        const int last = static_cast<int>(rule.scores.size()) - 1;
        const std::int64_t points = rule.scores[static_cast<std::size_t>(desk.player.bumper_level)];
        if (desk.player.bumper_level < last && ++m_bumper_hits >= rule.hits_per_level)
        {
            m_bumper_hits = 0;
            ++desk.player.bumper_level;
            desk.say("BUMPERS LEVEL " + std::to_string(desk.player.bumper_level + 1), 3, 1.5f);
            desk.announce({.kind = EventKind::LevelUp, .element = event.element, .value = desk.player.bumper_level});
        }
        return points;
    }

    void watch_trigger(Desk& desk, const GameEvent& event)
    {
        const auto& rule = desk.table().rules.spinner;
        if (!rule || event.element != rule->trigger || event.kind != EventKind::Entered)
            return;
        m_spinner_until = desk.now() + desk.steps(rule->time);
        desk.say("SPINNER X" + std::to_string(rule->factor), 2, 1.5f);
    }

    [[nodiscard]] int spinner_factor(const Desk& desk, Index spinner) const
    {
        const auto& rule = desk.table().rules.spinner;
        return rule && rule->spinner == spinner && desk.now() < m_spinner_until ? rule->factor : 1;
    }

    int m_bumper_hits = 0;
    std::int64_t m_spinner_until = 0;
};

} // namespace

RulePtr make_scoring(const Table&) { return std::make_unique<Scoring>(); }

} // namespace carom::pinball
