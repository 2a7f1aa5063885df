// The plunger: a rod on a slider with a true spring. A hand pulls it back, as a force law of the rod: a key at a steady speed, a stick to
// where it is held. The hand pulls and never pushes: let go, the spring throws the rod forward to its stop, and the ball with it.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

#include <algorithm>
#include <utility>

namespace carom::pinball {

namespace {

// The spring's length when it is pressed all the way: it must not reach its anchor.
constexpr float pressed_length = 0.02f; // m
// The rod's collar lands on a rubber ring.
constexpr float stop_restitution = 0.2f;
// How fast the hand takes up a wrong speed, and how it eases the rod to the end of its stroke.
constexpr float grip_time = 0.001f; // s
constexpr float ease_time = 0.005f; // s
constexpr float fastest_hand = 1;   // m/s

class PlungerDevice final : public Device
{
public:
    PlungerDevice(Playfield& field, Index index, const Plunger& def) : Device(index), m_field(field), m_def(def)
    {
        Scene& scene = field.scene();
        state.body = scene.create_body({.type = BodyType::Dynamic, .position = def.pos, .locks = {.angular = true}});
        scene.create_shape(state.body, box(def.half.x, def.half.y), field.moving_surface(index));
        scene.body(state.body).set_mass({.mass = def.mass, .center = {}, .inertia = 0});
        m_slider = scene.create_joint(PrismaticDef{.body_b = state.body,
                                                   .anchor_a = def.pos,
                                                   .axis_a = def.axis,
                                                   .enable_limit = true,
                                                   .lower_translation = -def.stroke,
                                                   .upper_translation = 0,
                                                   .limit_restitution = stop_restitution});
        const float at_rest = pressed_length + def.stroke;
        scene.create_joint(SpringDef{.body_b = state.body,
                                     .anchor_a = def.pos - at_rest * def.axis,
                                     .stiffness = def.k,
                                     .damping = def.c,
                                     .length = at_rest + def.preload / def.k});
        m_strength = 2 * (def.preload + def.k * def.stroke);
        scene.set_force_law(state.body, {.function = law, .user = this, .greatest_force = m_strength});
    }

    void before_step(Playfield& field) override
    {
        m_slope = std::as_const(field).scene().gravity();
        for (const ButtonChange& change : field.button_changes())
            turn_key(field, change);
    }

    void add_to(Hash& hash) const override { hash.add(m_scatter_factor); }

    void after_step(Playfield& field) override
    {
        const ConstJoint slider = field.scene().joint(m_slider);
        state.travel = -slider.coordinate();
        state.speed = -slider.speed();
    }

private:
    void turn_key(Playfield& field, const ButtonChange& change)
    {
        const bool pull = is_held(change.buttons);
        if (pull != state.down || change.buttons.rod != m_rod)
            field.scene().body(state.body).set_awake(true);
        m_rod = change.buttons.rod;
        if (pull == state.down)
            return;
        state.down = pull;
        const float travel = std::clamp(state.travel + static_cast<float>(change.time) * state.speed, 0.0f, m_def.stroke);
        if (pull)
            field.emit({.kind = EventKind::PlungerPulled, .element = index(), .point = m_def.pos});
        else
        {
            m_scatter_factor = field.scatter_factor();
            report_hit(field, {.kind = EventKind::PlungerReleased, .point = m_def.pos, .speed = travel});
        }
    }

    // The pull lasts for as much of the sub-step as the key is held.
    static Load law(void* user, const BodyMotion& motion)
    {
        const auto& plunger = *static_cast<PlungerDevice*>(user);
        const Buttons& buttons = plunger.m_field.buttons_at(motion.time);
        const float held = plunger.share_held(motion.time, static_cast<double>(motion.h));
        float force = held > 0 ? held * plunger.pull(motion) : 0;
        if (buttons.rod > 0) // two hands: the stronger one counts
            force = std::min(force, plunger.hold(motion, buttons.rod));
        else if (held <= 0)
            force = plunger.scatter(motion);
        return {.force = force * plunger.m_def.axis};
    }

    [[nodiscard]] static bool is_held(const Buttons& buttons) { return buttons.plunger || buttons.rod > 0; }

    [[nodiscard]] float share_held(double begin, double h) const
    {
        const double end = begin + h;
        double held = m_field.buttons_at(begin).plunger ? h : 0;
        for (const ButtonChange& change : m_field.button_changes())
            if (change.time > begin && change.time < end && change.buttons.plunger != m_field.buttons_at(begin).plunger)
                held += change.buttons.plunger ? end - change.time : change.time - end;
        return static_cast<float>(std::clamp(held / h, 0.0, 1.0));
    }

    [[nodiscard]] float travel(const BodyMotion& motion) const
    {
        return -dot(motion.pose.position - Position(m_def.pos), m_def.axis);
    }

    // No two strokes rub alike: the spring seems stronger or weaker.
    [[nodiscard]] float scatter(const BodyMotion& motion) const
    {
        return (m_scatter_factor * m_scatter_factor - 1) * m_def.k * std::max(0.0f, travel(motion));
    }

    // A key's hand, which goes back at its speed up to the end of the stroke.
    [[nodiscard]] float pull(const BodyMotion& motion) const
    {
        return bring_to(motion, -std::min(m_def.pull_speed, (m_def.stroke - travel(motion)) / ease_time));
    }

    // A stick's hand, which holds the rod where the stick is.
    [[nodiscard]] float hold(const BodyMotion& motion, std::uint8_t rod) const
    {
        const float behind = m_def.stroke * static_cast<float>(rod) / 255 - travel(motion);
        return std::min(0.0f, bring_to(motion, std::max(-behind / ease_time, -fastest_hand)));
    }

    // Along the axis: against spring and slope, and what brings the rod to the wanted speed; a hand is only so strong.
    [[nodiscard]] float bring_to(const BodyMotion& motion, float wanted) const
    {
        const float pulled = travel(motion);
        const float push = m_def.preload + m_def.k * pulled - m_def.c * wanted + m_def.mass * dot(m_slope, m_def.axis);
        const float lacking = wanted - dot(motion.velocity, m_def.axis);
        return std::clamp(m_def.mass / grip_time * lacking - push, -m_strength, m_strength);
    }

    const Playfield& m_field;
    const Plunger& m_def;
    JointId m_slider{};
    Vec2 m_slope{};       ///< acceleration down the table, m/s²
    float m_strength = 0; ///< N
    std::uint8_t m_rod = 0;
    float m_scatter_factor = 1; ///< of this stroke: its speed over that of the spring alone
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Plunger& plunger)
{
    return std::make_unique<PlungerDevice>(field, index, plunger);
}

} // namespace carom::pinball
