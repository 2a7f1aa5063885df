// A flipper: a rigid bat with its centre of mass on the pivot, moved by torque alone. Coil and return spring give the torque in every
// sub-step, as a force law of the bat. Near the upper stop a switch cuts the coil to its hold share.

#include "pinball/elements/coil.h"
#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace carom::pinball {

namespace {

// With its translation locked the mass does not matter; a bat with its shaft weighs about this.
constexpr float bat_mass = 0.08f;

class FlipperDevice final : public Device
{
public:
    FlipperDevice(Playfield& field, Index index, const Flipper& def)
        : Device(index), m_field(field), m_def(def), m_stroke(def.up - def.rest), m_coil(def.coil_torque, def.coil_rise),
          m_enabled(field.table().elements[index].enabled)
    {
        Scene& scene = field.scene();
        state.body =
            scene.create_body({.type = BodyType::Dynamic, .position = def.pivot, .locks = {.linear_x = true, .linear_y = true}});
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
        const float scatter = field.table().physics.scatter;
        scene.set_force_law(state.body,
                            {.function = law, .user = this, .greatest_torque = (1 + scatter) * (1 + scatter) * def.coil_torque});
        state.angle = def.rest;
    }

    void before_step(Playfield& field) override
    {
        m_step_began = field.time();
        for (const ButtonChange& change : field.button_changes())
            press(field, is_on(change.buttons));
    }

    void after_step(Playfield& field) override
    {
        const ConstBody body = field.scene().body(state.body);
        watch_stops(body.angle(), body.angular_velocity());
        state.angle = m_def.rest + body.angle();
        state.speed = body.angular_velocity();
        for (const StopHit& hit : m_stop_hits)
            report_hit(field, {.kind = EventKind::FlipperStop, .point = m_def.pivot, .speed = hit.speed, .value = hit.at == 1});
        m_stop_hits.clear();
    }

    void command(Playfield&, Command command) override
    {
        if (command == Command::Enable || command == Command::Disable)
            m_enabled = command == Command::Enable;
    }

    void add_to(Hash& hash) const override
    {
        m_coil.add_to(hash);
        hash.add(m_enabled);
        hash.add(m_at_stop);
        hash.add(m_scatter_factor);
        hash.add(m_seen_speed);
    }

private:
    struct StopHit
    {
        float speed; ///< rad/s
        int at;      ///< as m_at_stop
    };

    [[nodiscard]] bool is_on(const Buttons& buttons) const
    {
        return m_enabled && (m_def.input == Side::Left ? buttons.left : buttons.right);
    }

    // A bat that sleeps at its stop is not asked for its torque: whatever changes that wakes it.
    void press(Playfield& field, bool on)
    {
        if (on == state.down)
            return;
        field.scene().body(state.body).set_awake(true);
        field.emit({.kind = EventKind::FlipperCoil, .element = index(), .point = m_def.pivot, .value = on ? 1 : 0});
        state.down = on;
        if (on)
        {
            const float factor = field.scatter_factor();
            m_scatter_factor = factor * factor; // a speed goes with the root of the torque
        }
    }

    static Load law(void* user, const BodyMotion& motion)
    {
        auto& flipper = *static_cast<FlipperDevice*>(user);
        const float angle = flipper.angle_of(motion.pose.rotation);
        flipper.watch_stops(angle, motion.angular_velocity);
        const double begin = flipper.m_step_began + motion.time;
        const float torque = flipper.m_coil.mean_torque(
            begin, static_cast<double>(motion.h),
            [&](double time)
            {
                const float then = angle + motion.angular_velocity * static_cast<float>(time - begin);
                return flipper.target_torque(flipper.is_on(flipper.m_field.buttons_at(time - flipper.m_step_began)), then);
            });
        return {.torque = (flipper.m_stroke > 0 ? flipper.m_scatter_factor : -flipper.m_scatter_factor) * torque};
    }

    // A bat mostly rests, and the arc tangent is what its law costs.
    float angle_of(Rotation rotation)
    {
        if (rotation != m_seen_rotation)
            m_seen_angle = rotation.angle();
        m_seen_rotation = rotation;
        return m_seen_angle;
    }

    // Positive towards the upper stop; `angle` is that of the body.
    [[nodiscard]] float target_torque(bool on, float angle) const
    {
        if (!on)
            return -m_def.return_ratio * m_def.coil_torque;
        const float to_go = std::abs(m_stroke - angle);
        if (to_go >= m_def.eos)
            return m_def.coil_torque;
        const float x = to_go / m_def.eos;
        const float fade = x * x * x * x;
        return m_def.coil_torque * (m_def.hold_torque_ratio + (1 - m_def.hold_torque_ratio) * fade);
    }

    // The bat may have come to the stop and be on its way back since the last look: then it has turned round near it.
    void watch_stops(float angle, float speed)
    {
        const float progress = angle / m_stroke;
        const bool turned_round = m_seen_speed * speed < 0;
        const float reach = turned_round ? 0.1f : 0.01f;
        const int at = progress < reach ? -1 : progress > 1 - reach ? 1 : 0;
        if (at != 0 && at != m_at_stop)
            m_stop_hits.push_back({std::abs(m_seen_speed), at});
        // The bounces after that stay silent: it has to get half a stroke away before it can strike again.
        if (at != 0 || std::abs(progress - 0.5f) < 0.25f)
            m_at_stop = at;
        m_seen_speed = speed;
    }

    const Playfield& m_field;
    const Flipper& m_def;
    float m_stroke; ///< rad, signed
    Coil m_coil;
    double m_step_began = 0;
    float m_seen_speed = 0; ///< at the last look
    Rotation m_seen_rotation{};
    float m_seen_angle = 0;
    int m_at_stop = -1; ///< -1 lower, 1 upper, 0 between
    std::vector<StopHit> m_stop_hits{};
    float m_scatter_factor = 1; ///< of this stroke's torque
    bool m_enabled;
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Flipper& flipper)
{
    return std::make_unique<FlipperDevice>(field, index, flipper);
}

} // namespace carom::pinball
