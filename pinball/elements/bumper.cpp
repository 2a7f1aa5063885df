// The pop bumper ("bouncer"): a ring that throws back what arrives fast enough.

#include "pinball/elements/kicking.h"
#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

namespace carom::pinball {

namespace {

class BumperDevice final : public KickingDevice
{
public:
    BumperDevice(Playfield& field, Index index, const Bumper& def)
        : KickingDevice(index, {.speed = def.kick_speed, .threshold = def.threshold, .cooldown = def.cooldown})
    {
        add_kicker(field, field.add_fixed(field.table().elements[index].enabled), Circle{def.pos, def.radius});
    }
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Bumper& bumper)
{
    return std::make_unique<BumperDevice>(field, index, bumper);
}

} // namespace carom::pinball
