// A saucer: a ball that comes over its middle slowly enough falls in, is held for a while and thrown out again.

#include "pinball/elements/make.h"
#include "pinball/elements/zone.h"

#include <cmath>

namespace carom::pinball {

namespace {

class SaucerDevice final : public Zone
{
public:
    SaucerDevice(Playfield& field, Index index, const Saucer& def) : Zone(index), m_def(def)
    {
        field.scene().create_shape(field.add_fixed(field.table().elements[index].enabled), Circle{def.pos, def.radius},
                                   field.trigger(index));
    }

    void on_exit(Playfield& field, BodyId body, Ball* ball) override
    {
        Zone::on_exit(field, body, ball);
        if (body == m_thrown)
            m_thrown = {};
    }

    void after_step(Playfield& field) override
    {
        if (!m_held.is_null())
            wait(field);
        else
            look(field);
    }

    void command(Playfield&, Command command) override
    {
        if (command == Command::Hold)
            m_keep = true;
        if (command == Command::Eject || command == Command::Pulse)
        {
            m_keep = false;
            m_steps_left = 0;
        }
    }

    void add_to(Hash& hash) const override
    {
        Zone::add_to(hash);
        hash.add(m_steps_left);
        hash.add(m_keep);
        hash.add(m_held.slot);
        hash.add(m_thrown.slot);
    }

private:
    void look(Playfield& field)
    {
        for (const BodyId body : inside())
            if (Ball* ball = field.find_ball(body); ball && catches(*ball))
            {
                capture(field, *ball);
                return;
            }
    }

    [[nodiscard]] bool catches(const Ball& ball) const
    {
        const bool over = length(ball.state.position - Position(m_def.pos)) < m_def.radius;
        return over && !ball.drained && !ball.state.captive && ball.state.body != m_thrown &&
               length(ball.state.velocity) <= m_def.max_capture_speed;
    }

    void capture(Playfield& field, Ball& ball)
    {
        const float speed = length(ball.state.velocity);
        field.hold(ball, m_def.pos);
        m_held = ball.state.body;
        m_keep = false;
        m_steps_left = static_cast<int>(std::lround(m_def.hold / field.h()));
        state.down = true;
        report_hit(field, {.kind = EventKind::Captured, .point = m_def.pos, .speed = speed, .ball = ball.state.serial});
    }

    void wait(Playfield& field)
    {
        Ball* ball = field.find_ball(m_held);
        if (!ball)
        {
            m_held = {};
            state.down = false;
        }
        else if (!m_keep && m_steps_left-- <= 0)
        {
            eject(field, *ball);
        }
    }

    // Its own throw must not be caught: the ball is let go of until it has left.
    void eject(Playfield& field, Ball& ball)
    {
        const float scatter = field.random().between(-m_def.spread, m_def.spread);
        const Vec2 kick = field.scatter_factor() * rotate(Rotation::from_angle(scatter), m_def.kick);
        field.release(ball, kick);
        m_thrown = m_held;
        m_held = {};
        state.down = false;
        field.emit({.kind = EventKind::Ejected,
                    .element = index(),
                    .point = m_def.pos,
                    .speed = length(kick),
                    .ball = ball.state.serial});
    }

    const Saucer& m_def;
    BodyId m_held{};
    BodyId m_thrown{};
    int m_steps_left = 0;
    bool m_keep = false;
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Saucer& saucer)
{
    return std::make_unique<SaucerDevice>(field, index, saucer);
}

} // namespace carom::pinball
