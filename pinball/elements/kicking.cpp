#include "pinball/elements/kicking.h"

#include "pinball/elements/playfield.h"

namespace carom::pinball {

namespace {

// A coil that fires without having been struck throws what lies against it or as good as that.
constexpr float pulse_reach = 0.003f; // m

} // namespace

void KickingDevice::add_kicker(Playfield& field, BodyId body, const Geometry& geometry)
{
    m_kicker = field.scene().create_shape(body, geometry, field.surface(index()));
    arm(field);
}

void KickingDevice::arm(Playfield& field)
{
    m_scatter_factor = field.scatter_factor();
    ShapeDef surface = field.scene().shape(m_kicker).def();
    surface.kick = m_enabled ? m_kick : Kick{};
    surface.kick.speed *= m_scatter_factor;
    field.scene().shape(m_kicker).set_def(surface);
}

void KickingDevice::on_strike(Playfield& field, Ball& ball, const Strike& strike)
{
    if (strike.kick_speed <= 0)
        return;
    report_strike(field, EventKind::Fired, ball, strike, strike.kick_speed);
    if (field.table().physics.scatter > 0)
        arm(field);
}

void KickingDevice::command(Playfield& field, Command command)
{
    if (command == Command::Pulse)
        pulse(field);
    if (command != Command::Enable && command != Command::Disable)
        return;
    m_enabled = command == Command::Enable;
    arm(field);
}

void KickingDevice::pulse(Playfield& field)
{
    state.last_hit = field.step_count();
    for (Ball& ball : field.all_balls())
    {
        if (!ball.state.is_free())
            continue;
        const float reach = field.table().ball.radius + pulse_reach;
        const auto nearest = field.scene().closest_point(ball.state.position, reach, {.mask = fixed_category});
        if (nearest && nearest->shape == m_kicker)
            field.throw_ball(ball, m_kick.speed * nearest->normal);
    }
}

void KickingDevice::add_to(Hash& hash) const
{
    hash.add(m_scatter_factor);
    hash.add(m_enabled);
}

} // namespace carom::pinball
