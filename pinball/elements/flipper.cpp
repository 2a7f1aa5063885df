// A flipper: a rigid bat with its centre of mass on the pivot, moved by torque alone. Coil and return spring set a
// target; the torque follows it linearly (the coil's rise). Near the upper stop a switch cuts the coil to its hold share.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

// With its translation locked the mass does not matter; a bat with its shaft weighs about this.
constexpr float bat_mass = 0.08f;

class FlipperDevice final : public Device
{
public:
    FlipperDevice(Playfield& field, Index index, const Flipper& def)
        : Device(index), m_def(def), m_stroke(def.up - def.rest), m_enabled(field.table().elements[index].enabled)
    {
        Scene& scene = field.scene();
        state.body = scene.create_body({.type = BodyType::Dynamic,
                                        .position = def.pivot,
                                        .locks = {.linear_x = true, .linear_y = true},
                                        .can_sleep = false});
        // The body's angle is 0 at rest, so that no stroke comes near the seam at pi.
        const Vec2 tip = rotate(Rotation::from_angle(def.rest), {def.length, 0});
        scene.create_shape(state.body, Capsule{{}, tip, def.base_radius, def.tip_radius}, field.moving_surface(index));
        scene.body(state.body).set_mass({.mass = bat_mass, .center = {}, .inertia = def.inertia});
        scene.create_joint(RevoluteDef{.body_b = state.body,
                                       .anchor_a = def.pivot,
                                       .enable_limit = true,
                                       .lower_angle = std::min(0.0f, m_stroke),
                                       .upper_angle = std::max(0.0f, m_stroke),
                                       .limit_restitution = def.stop_restitution});
        state.angle = def.rest;
    }

    void before_step(Playfield& field) override
    {
        press(field, m_enabled && (m_def.input == Side::Left ? field.buttons().left : field.buttons().right));
        const float mean = move_torque(field.h());
        field.scene().body(state.body).apply_torque(m_stroke > 0 ? mean : -mean);
    }

    void after_step(Playfield& field) override
    {
        const ConstBody body = field.scene().body(state.body);
        report_stop(field, body.angle() / m_stroke, body.angular_velocity());
        state.angle = m_def.rest + body.angle();
        state.speed = body.angular_velocity();
    }

    void command(Playfield&, Command command) override
    {
        if (command == Command::Enable || command == Command::Disable)
            m_enabled = command == Command::Enable;
    }

    void add_to(Hash& hash) const override
    {
        hash.add(m_torque);
        hash.add(m_enabled);
        hash.add(m_at_stop);
    }

private:
    void press(Playfield& field, bool on)
    {
        if (on != state.down)
            field.emit({.kind = EventKind::FlipperCoil, .element = index(), .point = m_def.pivot, .value = on ? 1 : 0});
        state.down = on;
    }

    // The coil's rise: the torque goes to its target in a straight line. Gives the mean over the step.
    [[nodiscard]] float move_torque(float h)
    {
        const float before = m_torque;
        const float most = m_def.coil_rise > 0 ? h * m_def.coil_torque / m_def.coil_rise : 2 * m_def.coil_torque;
        m_torque += std::clamp(target_torque() - m_torque, -most, most);
        return m_def.coil_rise > 0 ? 0.5f * (before + m_torque) : m_torque;
    }

    // Positive towards the upper stop.
    [[nodiscard]] float target_torque() const
    {
        if (!state.down)
            return -m_def.return_ratio * m_def.coil_torque;
        const float to_go = std::abs(m_def.up - state.angle);
        if (to_go >= m_def.eos)
            return m_def.coil_torque;
        const float x = to_go / m_def.eos;
        const float fade = x * x * x * x;
        return m_def.coil_torque * (m_def.hold_torque_ratio + (1 - m_def.hold_torque_ratio) * fade);
    }

    // The bat may have come to the stop and be on its way back within one step: then it has turned round near it.
    void report_stop(Playfield& field, float progress, float speed)
    {
        const bool turned_round = state.speed * speed < 0;
        const float reach = turned_round ? 0.1f : 0.01f;
        const int at = progress < reach ? -1 : progress > 1 - reach ? 1 : 0;
        if (at != 0 && at != m_at_stop)
            report_hit(
                field,
                {.kind = EventKind::FlipperStop, .point = m_def.pivot, .speed = std::abs(state.speed), .value = at == 1 ? 1 : 0});
        // The bounces after that stay silent: it has to get half a stroke away before it can strike again.
        if (at != 0 || std::abs(progress - 0.5f) < 0.25f)
            m_at_stop = at;
    }

    const Flipper& m_def;
    float m_stroke;     ///< rad, signed
    float m_torque = 0; ///< N m, positive towards the upper stop
    int m_at_stop = -1; ///< -1 lower, 1 upper, 0 between
    bool m_enabled;
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Flipper& flipper)
{
    return std::make_unique<FlipperDevice>(field, index, flipper);
}

} // namespace carom::pinball
