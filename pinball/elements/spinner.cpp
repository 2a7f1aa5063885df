// A spinner: a flag that hangs across a lane. A ball that meets it gives up momentum to it as two bodies do that go on
// together: with the flag's inertia I at an arm s it acts like a mass I/s², and what the ball loses turns the flag. The arm
// follows from the share of its speed that a ball loses to a flag at rest, which is what a maker of tables can measure.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

#include <cmath>

namespace carom::pinball {

namespace {

// The flag is a little heavier below, so that it comes to rest hanging: swings of 1 Hz, (2 pi)² 1/s².
constexpr float righting = 39.5f;

class SpinnerDevice final : public Device
{
public:
    SpinnerDevice(Playfield& field, Index index, const Spinner& def)
        : Device(index), m_def(def), m_normal(normalize(perp(def.b - def.a)))
    {
        const float share = def.drag_on_ball;
        m_mass = field.table().ball.mass * share / (1 - share);
        m_arm = m_mass > 0 ? std::sqrt(def.inertia / m_mass) : 1.0f;
        field.scene().create_shape(field.add_fixed(field.table().elements[index].enabled), Segment{.a = def.a, .b = def.b},
                                   field.trigger(index));
    }

    void on_enter(Playfield& field, Ball& ball) override
    {
        const float speed = dot(ball.state.velocity, m_normal);
        const float flag = state.speed * m_arm;
        const bool runs_away = speed > 0 ? flag >= speed : flag <= speed;
        if (runs_away)
            return;
        const float mass = field.table().ball.mass;
        const float together = (mass * speed + m_mass * flag) / (mass + m_mass);
        Body body = field.scene().body(ball.state.body);
        body.apply_impulse((mass * (together - speed)) * m_normal);
        ball.state.velocity = body.velocity();
        state.speed = together / m_arm;
        state.last_hit = field.step_count();
    }

    void after_step(Playfield& field) override
    {
        const float h = field.h();
        state.speed -= h * (m_def.damping * state.speed + righting * Rotation::from_angle(state.angle).s);
        const float before = state.angle;
        state.angle += h * state.speed;
        if (half_turns(before) != half_turns(state.angle))
            report_hit(field, {.kind = EventKind::Spun, .point = 0.5f * (m_def.a + m_def.b), .speed = std::abs(state.speed)});
        if (state.angle > pi)
            state.angle -= 2 * pi;
        else if (state.angle < -pi)
            state.angle += 2 * pi;
    }

private:
    // The switch closes when the flag lies flat, twice a turn.
    [[nodiscard]] static int half_turns(float angle) { return angle > 0.5f * pi ? 1 : angle < -0.5f * pi ? -1 : 0; }

    const Spinner& m_def;
    Vec2 m_normal;
    float m_mass = 0; ///< kg that the flag weighs at its arm
    float m_arm = 1;  ///< m
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Spinner& spinner)
{
    return std::make_unique<SpinnerDevice>(field, index, spinner);
}

} // namespace carom::pinball
