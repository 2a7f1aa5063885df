// The ball search: when a ball is out, nobody holds it on a flipper, and no switch has closed for a while, it lies somewhere. All coils
// but the flippers' fire, again and again; when that does not help, or it falls back to where it lay, the ball is written off and another one comes.
// So no ball ends a game.

#include "pinball/rules/rule.h"

namespace carom::pinball {

namespace {

constexpr float pause = 4;     // s between two rounds
constexpr float recovery = 10; // s that a ball must keep moving after a round to count as found
constexpr int rounds = 3;

// Whatever tells that a ball moves on the playfield. The plunger's lane does not count: there it may hop up and down for ever.
bool is_sign_of_life(const Table& table, const GameEvent& event)
{
    using enum EventKind;
    return is_playfield_switch(table, event) || event.kind == Launched || event.kind == Ejected;
}

class BallSearch final : public Rule
{
public:
    explicit BallSearch(float time) : m_time(time) {}

    [[nodiscard]] bool works_tilted() const override { return true; }
    void start_ball(Desk& desk) override { begin(desk); }

    void on_event(Desk& desk, const GameEvent& event) override
    {
        if (!is_sign_of_life(desk.table(), event))
            return;
        m_since = desk.now();
        if (m_since - m_searched_at > desk.steps(recovery))
            m_round = 0;
    }

    void on_step(Desk& desk) override
    {
        const bool plays = desk.phase == Phase::InPlay || desk.phase == Phase::Ready;
        if (!plays || desk.knows_all_balls || desk.to_serve > 0)
            return begin(desk);
        if (desk.flipper_is_held)
            ++m_since; // time stands still
        if (desk.now() - m_since < desk.steps(m_round == 0 ? m_time : pause))
            return;
        ++m_round;
        m_round <= rounds ? search(desk) : give_up(desk);
    }

    void add_to(Hash& hash) const override
    {
        hash.add(m_since);
        hash.add(m_searched_at);
        hash.add(m_round);
    }

private:
    void begin(const Desk& desk)
    {
        m_since = desk.now();
        m_round = 0;
    }

    void search(Desk& desk)
    {
        m_since = m_searched_at = desk.now();
        for (Index i = 0; i < desk.table().elements.size(); ++i)
            if (desk.table().elements[i].enabled)
                desk.order(i, Command::Pulse);
        desk.say("BALL SEARCH", 7, 2);
        desk.announce({.kind = EventKind::BallSearch, .value = m_round});
    }

    void give_up(Desk& desk)
    {
        desk.recalls = true;
        desk.say("BALL MISSING", 7, 2);
        begin(desk);
    }

    float m_time;
    std::int64_t m_since = 0; ///< step of the last sign of life or round
    std::int64_t m_searched_at = 0;
    int m_round = 0;
};

} // namespace

RulePtr make_ball_search(float time) { return std::make_unique<BallSearch>(time); }

} // namespace carom::pinball
