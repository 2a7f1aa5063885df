// Targets: one that stands fast, and one that drops and never rises into a ball.

#include "pinball/elements/make.h"
#include "pinball/elements/playfield.h"

namespace carom::pinball {

namespace {

class StandupDevice final : public Device
{
public:
    StandupDevice(Playfield& field, Index index, const Standup& def) : Device(index), m_min_speed(def.min_speed)
    {
        field.scene().create_shape(field.add_fixed(field.table().elements[index].enabled),
                                   Segment{.a = def.a, .b = def.b, .half_thickness = def.radius}, field.surface(index));
    }

    void on_strike(Playfield& field, Ball& ball, const Strike& strike) override
    {
        if (strike.speed >= m_min_speed)
            report_strike(field, EventKind::Hit, ball, strike, strike.speed);
    }

private:
    float m_min_speed;
};

class DropTargetDevice final : public Device
{
public:
    DropTargetDevice(Playfield& field, Index index, const DropTarget& def)
        : Device(index), m_def(def), m_body(field.add_fixed(field.table().elements[index].enabled))
    {
        state.down = !field.table().elements[index].enabled;
        field.scene().create_shape(m_body, Segment{.a = def.a, .b = def.b, .half_thickness = def.radius}, field.surface(index));
    }

    void on_strike(Playfield& field, Ball& ball, const Strike& strike) override
    {
        if (strike.speed < m_def.min_speed || state.down)
            return;
        drop(field);
        report_strike(field, EventKind::Fell, ball, strike, strike.speed);
    }

    void after_step(Playfield& field) override
    {
        if (!m_wants_up || !is_free(field))
            return;
        m_wants_up = false;
        state.down = false;
        field.scene().body(m_body).set_enabled(true);
        field.emit({.kind = EventKind::Raised, .element = index(), .point = 0.5f * (m_def.a + m_def.b)});
    }

    void command(Playfield& field, Command command) override
    {
        if (command == Command::Drop)
            drop(field);
        if (command == Command::Raise)
            m_wants_up = state.down;
    }

    void add_to(Hash& hash) const override { hash.add(m_wants_up); }

private:
    void drop(Playfield& field)
    {
        state.down = true;
        m_wants_up = false;
        field.scene().body(m_body).set_enabled(false);
    }

    // A little more room than the target takes, so that the ball beside it is not even touched.
    [[nodiscard]] bool is_free(Playfield& field) const
    {
        const float radius = m_def.radius + 0.0005f;
        const Capsule room{.a = m_def.a, .b = m_def.b, .radius_a = radius, .radius_b = radius};
        return field.scene().overlap_shape(room, {}, {.mask = ball_category}).empty();
    }

    const DropTarget& m_def;
    BodyId m_body;
    bool m_wants_up = false;
};

} // namespace

DevicePtr make(Playfield& field, Index index, const Standup& target)
{
    return std::make_unique<StandupDevice>(field, index, target);
}

DevicePtr make(Playfield& field, Index index, const DropTarget& target)
{
    return std::make_unique<DropTargetDevice>(field, index, target);
}

} // namespace carom::pinball
