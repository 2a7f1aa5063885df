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

} // namespace carom::pinball
