// A slingshot: a rubber band round three posts. Its face kicks in the middle and is plain rubber towards the posts, where
// a real one is too taut to be thrown.

#include "pinball/elements/kicking.h"
#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

namespace carom::pinball {

namespace {

// Share of the face at either end that does not kick.
constexpr float taut_share = 0.15f;

class SlingshotDevice final : public KickingDevice
{
public:
    SlingshotDevice(Playfield& field, Index index, const Slingshot& def)
        : KickingDevice(index, {.speed = def.kick_speed, .threshold = def.threshold, .cooldown = def.cooldown})
    {
        const auto [a, b, c] = def.corners;
        const Vec2 near_a = a + taut_share * (b - a);
        const Vec2 near_b = b - taut_share * (b - a);
        const BodyId body = field.add_fixed(field.table().elements[index].enabled);
        field.scene().create_shape(body,
                                   Chain{.start = near_b, .pieces = {{b}, {c}, {a}, {near_a}}, .half_thickness = def.radius},
                                   field.surface(index));
        add_kicker(field, body, Segment{.a = near_a, .b = near_b, .half_thickness = def.radius});
    }
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Slingshot& slingshot)
{
    return std::make_unique<SlingshotDevice>(field, index, slingshot);
}

} // namespace carom::pinball
