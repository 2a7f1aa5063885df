// The bash target: a box on a slider, held by springs, that a hard ball pushes in.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

namespace carom::pinball {

namespace {

// The box comes back against a felt pad.
constexpr float target_stop_restitution = 0.1f;

class SprungTargetDevice final : public Device
{
public:
    SprungTargetDevice(Playfield& field, Index index, const SprungTarget& def)
        : Device(index), m_pos(def.pos), m_axis(def.axis), m_min_impulse(def.min_impulse)
    {
        Scene& scene = field.scene();
        state.body = scene.create_body({.type = BodyType::Dynamic,
                                        .position = def.pos,
                                        .locks = {.angular = true},
                                        .enabled = field.table().elements[index].enabled});
        scene.create_shape(state.body, box(def.half.x, def.half.y), field.moving_surface(index));
        scene.body(state.body).set_mass({.mass = def.mass, .center = {}, .inertia = 0});
        scene.create_joint(PrismaticDef{.body_b = state.body,
                                        .anchor_a = def.pos,
                                        .axis_a = def.axis,
                                        .enable_limit = true,
                                        .lower_translation = 0,
                                        .upper_translation = def.max_travel,
                                        .limit_restitution = target_stop_restitution});
        for (const TargetSpring& spring : def.springs)
            scene.create_joint(SpringDef{.body_b = state.body,
                                         .anchor_a = spring.anchor,
                                         .anchor_b = spring.local,
                                         .stiffness = spring.k,
                                         .damping = spring.c,
                                         .length = spring.rest});
    }

    void on_strike(Playfield& field, Ball& ball, const Strike& strike) override
    {
        if (strike.impulse >= m_min_impulse)
            report_strike(field, EventKind::Hit, ball, strike, strike.speed);
    }

    void after_step(Playfield& field) override
    {
        const ConstBody body = field.scene().body(state.body);
        state.travel = dot(body.position() - Position(m_pos), m_axis);
        state.speed = dot(body.velocity(), m_axis);
    }

private:
    Vec2 m_pos;
    Vec2 m_axis;
    float m_min_impulse;
};

} // namespace

DevicePtr make(Playfield& field, Index index, const SprungTarget& target)
{
    return std::make_unique<SprungTargetDevice>(field, index, target);
}

} // namespace carom::pinball
