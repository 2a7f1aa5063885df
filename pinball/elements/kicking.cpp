#include "pinball/elements/kicking.h"

#include "pinball/elements/playfield.h"

namespace carom::pinball {

void KickingDevice::add_kicker(Playfield& field, BodyId body, const Geometry& geometry)
{
    ShapeDef surface = field.surface(index());
    surface.kick = m_kick;
    m_kicker = field.scene().create_shape(body, geometry, surface);
}

void KickingDevice::on_strike(Playfield& field, Ball& ball, const Strike& strike)
{
    if (strike.kick_speed > 0)
        report_strike(field, EventKind::Fired, ball, strike, strike.kick_speed);
}

void KickingDevice::command(Playfield& field, Command command)
{
    if (command != Command::Enable && command != Command::Disable)
        return;
    ShapeDef surface = field.scene().shape(m_kicker).def();
    surface.kick = command == Command::Enable ? m_kick : Kick{};
    field.scene().shape(m_kicker).set_def(surface);
}

} // namespace carom::pinball
