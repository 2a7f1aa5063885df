// Rollovers and the drain: they report the ball that enters them; a drain also takes it.

#include "pinball/elements/make.h"
#include "pinball/elements/zone.h"

namespace carom::pinball {

namespace {

Geometry outline(const Sensor& def)
{
    if (def.radius > 0)
        return Circle{def.pos, def.radius};
    return box(def.half.x, def.half.y, def.pos);
}

class SensorDevice final : public Zone
{
public:
    SensorDevice(Playfield& field, Index index, const Sensor& def) : Zone(index), m_kills(def.kills)
    {
        field.scene().create_shape(field.add_fixed(field.table().elements[index].enabled), outline(def), field.trigger(index));
    }

    void on_enter(Playfield& field, Ball& ball) override
    {
        Zone::on_enter(field, ball);
        const bool takes = m_kills && !ball.state.captive;
        ball.drained = ball.drained || takes;
        report_hit(field, {.kind = takes ? EventKind::Drained : EventKind::Entered,
                           .point = ball.state.position,
                           .speed = length(ball.state.velocity),
                           .ball = ball.state.serial});
    }

    void on_exit(Playfield& field, BodyId body, Ball* ball) override
    {
        Zone::on_exit(field, body, ball);
        if (ball)
            field.emit({.kind = EventKind::Left,
                        .element = index(),
                        .point = ball->state.position,
                        .speed = length(ball->state.velocity),
                        .ball = ball->state.serial});
    }

private:
    bool m_kills;
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Sensor& sensor)
{
    return std::make_unique<SensorDevice>(field, index, sensor);
}

} // namespace carom::pinball
