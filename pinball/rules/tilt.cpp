// Tilt: the bob that touches its ring warns; one touch too many and the ball is lost. The coils are dead until it has drained, and
// its bonus is not paid. One swing counts once.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

constexpr float one_swing = 0.6f;   // s
constexpr float settle_time = 1.5f; // s after the last touch before another ball is served

class Tilt final : public Rule
{
public:
    explicit Tilt(int warnings) : m_most(warnings) {}

    [[nodiscard]] bool works_tilted() const override { return true; }

    void start_ball(Desk&) override
    {
        m_warnings = 0;
        m_deaf_until = 0;
    }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (event.kind != EventKind::BobTouched || desk.phase != Phase::InPlay)
            return;
        desk.shaken_until = desk.now() + desk.steps(settle_time);
        if (desk.tilted || desk.now() < m_deaf_until)
            return;
        m_deaf_until = desk.now() + desk.steps(one_swing);
        if (m_warnings == m_most)
            return tilt(desk);
        ++m_warnings;
        desk.say(m_warnings == m_most ? "LAST WARNING" : "WARNING", 8, 2);
        desk.announce({.kind = EventKind::Warned, .value = m_warnings});
    }

    void add_to(Hash& hash) const override
    {
        hash.add(m_warnings);
        hash.add(m_deaf_until);
    }

private:
    static void tilt(Desk& desk)
    {
        desk.tilted = true;
        desk.player.bonus = 0;
        desk.saved_until = 0;
        desk.flashing = none;
        desk.order_all(Command::Disable);
        desk.announce({.kind = EventKind::Tilted});
    }

    int m_most;
    int m_warnings = 0;
    std::int64_t m_deaf_until = 0;
};

} // namespace

RulePtr make_tilt(int warnings) { return std::make_unique<Tilt>(warnings); }

} // namespace carom::pinball
