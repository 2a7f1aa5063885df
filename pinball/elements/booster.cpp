// A booster: a stretch of the table that pushes the balls on it. The push is a field of its trigger shape.

#include "pinball/elements/make.h"
#include "pinball/elements/zone.h"

namespace carom::pinball {

namespace {

class BoosterDevice final : public Zone
{
public:
    BoosterDevice(Playfield& field, Index index, const Booster& def) : Zone(index)
    {
        ShapeDef shape = field.trigger(index);
        shape.field = {.force = def.force, .only_if_moving_along = def.only_if_moving_along};
        field.scene().create_shape(field.add_fixed(field.table().elements[index].enabled), box(def.half.x, def.half.y, def.pos),
                                   shape);
    }

    void on_enter(Playfield& field, Ball& ball) override
    {
        Zone::on_enter(field, ball);
        report_hit(field, {.kind = EventKind::Entered,
                           .point = ball.state.position,
                           .speed = length(ball.state.velocity),
                           .ball = ball.state.serial});
    }
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Booster& booster)
{
    return std::make_unique<BoosterDevice>(field, index, booster);
}

} // namespace carom::pinball
