// The pop bumper ("bouncer"): a ring that throws back what arrives fast enough. The kick itself is data of its shape.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

namespace carom::pinball {

namespace {

class BumperDevice final : public Device
{
public:
    BumperDevice(Playfield& field, Index index, const Bumper& def)
        : Device(index), m_kick{.speed = def.kick_speed, .threshold = def.threshold, .cooldown = def.cooldown}
    {
        ShapeDef surface = field.surface(index);
        surface.kick = m_kick;
        m_ring = field.scene().create_shape(field.add_fixed(field.table().elements[index].enabled), Circle{def.pos, def.radius},
                                            surface);
    }

    void on_strike(Playfield& field, Ball& ball, const Strike& strike) override
    {
        if (strike.kick_speed > 0)
            report_hit(field, {.kind = EventKind::Fired,
                               .point = strike.point,
                               .normal = strike.normal,
                               .impulse = strike.impulse,
                               .speed = strike.kick_speed,
                               .ball = ball.state.serial});
    }

    void command(Playfield& field, Command command) override
    {
        if (command != Command::Enable && command != Command::Disable)
            return;
        ShapeDef surface = field.scene().shape(m_ring).def();
        surface.kick = command == Command::Enable ? m_kick : Kick{};
        field.scene().shape(m_ring).set_def(surface);
    }

private:
    Kick m_kick;
    ShapeId m_ring{};
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Bumper& bumper)
{
    return std::make_unique<BumperDevice>(field, index, bumper);
}

} // namespace carom::pinball
