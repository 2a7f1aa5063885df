// The plunger: a rod on a slider with a true spring. The key pulls it back at a steady speed; let go, the spring throws it
// forward to its stop, and the ball with it.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

namespace carom::pinball {

namespace {

// The spring's length when it is pressed all the way: it must not reach its anchor.
constexpr float pressed_length = 0.02f; // m
// The rod's collar lands on a rubber ring.
constexpr float stop_restitution = 0.2f;

class PlungerDevice final : public Device
{
public:
    PlungerDevice(Playfield& field, Index index, const Plunger& def) : Device(index), m_def(def)
    {
        Scene& scene = field.scene();
        state.body =
            scene.create_body({.type = BodyType::Dynamic, .position = def.pos, .locks = {.angular = true}, .can_sleep = false});
        scene.create_shape(state.body, box(def.half.x, def.half.y), field.moving_surface(index));
        scene.body(state.body).set_mass({.mass = def.mass, .center = {}, .inertia = 0});
        m_slider = scene.create_joint(slider(false));
        const float at_rest = pressed_length + def.stroke;
        scene.create_joint(SpringDef{.body_b = state.body,
                                     .anchor_a = def.pos - at_rest * def.axis,
                                     .stiffness = def.k,
                                     .damping = def.c,
                                     .length = at_rest + def.preload / def.k});
    }

    void before_step(Playfield& field) override
    {
        const bool pull = field.buttons().plunger;
        if (pull == state.down)
            return;
        state.down = pull;
        field.scene().joint(m_slider).set_def(slider(pull));
        if (pull)
            field.emit({.kind = EventKind::PlungerPulled, .element = index(), .point = m_def.pos});
        else
            report_hit(field, {.kind = EventKind::PlungerReleased, .point = m_def.pos, .speed = state.travel});
    }

    void after_step(Playfield& field) override
    {
        const ConstJoint slider = field.scene().joint(m_slider);
        state.travel = -slider.coordinate();
        state.speed = -slider.speed();
    }

private:
    [[nodiscard]] PrismaticDef slider(bool pulled) const
    {
        return {.body_b = state.body,
                .anchor_a = m_def.pos,
                .axis_a = m_def.axis,
                .enable_limit = true,
                .lower_translation = -m_def.stroke,
                .upper_translation = 0,
                .limit_restitution = stop_restitution,
                .enable_motor = pulled,
                .motor_speed = -m_def.pull_speed,
                .max_motor_force = 2 * (m_def.preload + m_def.k * m_def.stroke)};
    }

    const Plunger& m_def;
    JointId m_slider{};
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Plunger& plunger)
{
    return std::make_unique<PlungerDevice>(field, index, plunger);
}

} // namespace carom::pinball
