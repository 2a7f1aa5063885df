#include "pinball/elements/device.h"

#include "pinball/elements/playfield.h"

namespace carom::pinball {

void Device::report_hit(Playfield& field, GameEvent event)
{
    event.element = m_index;
    state.last_hit = field.step_count();
    ++state.hits;
    field.emit(event);
}

void Device::report_strike(Playfield& field, EventKind kind, const Ball& ball, const Strike& strike, float speed)
{
    report_hit(field, {.kind = kind,
                       .point = strike.point,
                       .normal = strike.normal,
                       .impulse = strike.impulse,
                       .speed = speed,
                       .ball = ball.state.serial});
}

} // namespace carom::pinball
