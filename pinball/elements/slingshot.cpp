// A slingshot: a rubber band round three posts. Its face kicks in the middle and is plain rubber towards the posts, where
// a real one is too taut to be thrown.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

namespace carom::pinball {

namespace {

// Share of the face at either end that does not kick.
constexpr float taut_share = 0.15f;

class SlingshotDevice final : public Device
{
public:
    SlingshotDevice(Playfield& field, Index index, const Slingshot& def)
        : Device(index), m_kick{.speed = def.kick_speed, .threshold = def.threshold, .cooldown = def.cooldown}
    {
        const auto [a, b, c] = def.corners;
        const Vec2 near_a = a + taut_share * (b - a);
        const Vec2 near_b = b - taut_share * (b - a);
        const BodyId body = field.add_fixed(field.table().elements[index].enabled);
        ShapeDef surface = field.surface(index);
        field.scene().create_shape(
            body, Chain{.start = near_b, .pieces = {{b}, {c}, {a}, {near_a}}, .half_thickness = def.radius}, surface);
        surface.kick = m_kick;
        m_face = field.scene().create_shape(body, Segment{.a = near_a, .b = near_b, .half_thickness = def.radius}, surface);
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
        ShapeDef surface = field.scene().shape(m_face).def();
        surface.kick = command == Command::Enable ? m_kick : Kick{};
        field.scene().shape(m_face).set_def(surface);
    }

private:
    Kick m_kick;
    ShapeId m_face{};
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Slingshot& slingshot)
{
    return std::make_unique<SlingshotDevice>(field, index, slingshot);
}

} // namespace carom::pinball
