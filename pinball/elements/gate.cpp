// A one-way gate: a wire that swings open for a ball from one side and blocks it from the other. That is data of its
// shape; a trigger on the same line lets the wire be seen to move.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

#include <algorithm>

namespace carom::pinball {

namespace {

constexpr float fully_open = 1.2f; // rad
constexpr float fall_rate = 6.0f;  // 1/s: how fast the wire swings back
constexpr float lift_rate = 60.0f; // 1/s

class GateDevice final : public Device
{
public:
    GateDevice(Playfield& field, Index index, const Gate& def) : Device(index), m_def(def)
    {
        const BodyId body = field.add_fixed(field.table().elements[index].enabled);
        ShapeDef surface = field.surface(index);
        surface.one_way = def.open_dir;
        const Segment wire{.a = def.a, .b = def.b, .half_thickness = def.radius};
        field.scene().create_shape(body, wire, surface);
        field.scene().create_shape(body, wire, field.trigger(index));
    }

    void on_enter(Playfield&, Ball& ball) override { m_opened = m_opened || !is_beyond(ball); }

    void on_exit(Playfield& field, BodyId, Ball* ball) override
    {
        if (m_opened && ball && is_beyond(*ball))
            report_hit(field, {.kind = EventKind::Passed,
                               .point = ball->state.position,
                               .speed = length(ball->state.velocity),
                               .ball = ball->state.serial});
        m_opened = false;
    }

    void after_step(Playfield& field) override
    {
        const float h = field.h();
        state.speed = m_opened ? lift_rate * (fully_open - state.angle) : -fall_rate * state.angle;
        state.angle = std::clamp(state.angle + h * state.speed, 0.0f, fully_open);
    }

    void add_to(Hash& hash) const override { hash.add(m_opened); }

private:
    [[nodiscard]] bool is_beyond(const Ball& ball) const
    {
        return dot(ball.state.position - Position(m_def.a), m_def.open_dir) > 0;
    }

    const Gate& m_def;
    bool m_opened = false;
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Gate& gate) { return std::make_unique<GateDevice>(field, index, gate); }

} // namespace carom::pinball
