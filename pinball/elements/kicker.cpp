// The kickback: while lit it throws back a ball that comes at it, once for each time it is lit if the rules say so.

#include "pinball/elements/make.h"
#include "pinball/elements/zone.h"

namespace carom::pinball {

namespace {

class KickerDevice final : public Zone
{
public:
    KickerDevice(Playfield& field, Index index, const Kicker& def)
        : Zone(index), m_def(def), m_enabled(field.table().elements[index].enabled)
    {
        state.lit = def.lit;
        field.scene().create_shape(field.add_fixed(), box(def.half.x, def.half.y, def.pos), field.trigger(index));
    }

    void after_step(Playfield& field) override
    {
        if (!state.lit || !m_enabled)
            return;
        for (const BodyId body : inside())
            if (Ball* ball = field.find_ball(body); ball && !ball->drained && dot(ball->state.velocity, m_def.kick) <= 0)
                fire(field, *ball);
    }

    void command(Playfield& field, Command command) override
    {
        if (command == Command::Pulse)
            for (const BodyId body : inside())
                if (Ball* ball = field.find_ball(body); ball && !ball->drained)
                    fire(field, *ball);
        if (command == Command::Light || command == Command::Unlight)
            state.lit = command == Command::Light;
        if (command == Command::Enable || command == Command::Disable)
            m_enabled = command == Command::Enable;
    }

    void add_to(Hash& hash) const override
    {
        Zone::add_to(hash);
        hash.add(m_enabled);
    }

private:
    void fire(Playfield& field, Ball& ball)
    {
        const Vec2 kick = field.scatter_factor() * m_def.kick;
        const Vec2 change = kick - ball.state.velocity;
        field.throw_ball(ball, kick);
        report_hit(field, {.kind = EventKind::Fired,
                           .point = ball.state.position,
                           .normal = normalize(m_def.kick),
                           .impulse = field.table().ball.mass * length(change),
                           .speed = length(kick),
                           .ball = ball.state.serial});
    }

    const Kicker& m_def;
    bool m_enabled;
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Kicker& kicker)
{
    return std::make_unique<KickerDevice>(field, index, kicker);
}

} // namespace carom::pinball
