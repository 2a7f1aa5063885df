#include "pinball/elements/cabinet.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::pinball {

namespace {

// The cabinet swings ten times a second at most.
constexpr float longest_slice = 0.00025f; // s

// Smaller movements cannot be seen; a cabinet at rest costs nothing.
constexpr float still_speed = 2e-4f;  // m/s
constexpr float still_offset = 5e-6f; // m

// A hand that has pushed must be drawn back before it can push again.
constexpr double hand_back = 0.15; // s

constexpr float gravity = 9.81f;    // m/s²
constexpr float bob_damping = 0.8f; // 1/s
constexpr float ring_restitution = 0.8f;
constexpr float still_swing = 0.02f; // share of the ring
constexpr float near_ring = 0.7f;    // share of the ring that the bob must come back to before it can touch it anew

int slices_of(float h) { return std::max(1, static_cast<int>(std::ceil(h / longest_slice - 1e-3f))); }

} // namespace

// --- The bob ---------------------------------------------------------------------------------------------------------

TiltBob::TiltBob(const CabinetDef& def)
    : m_ring(def.bob_length * Rotation::from_angle(def.tilt).s), m_stiffness(gravity / def.bob_length)
{}

bool TiltBob::step(Vec2 cabinet_acceleration, float h)
{
    m_velocity += h * (-cabinet_acceleration - m_stiffness * m_offset - bob_damping * m_velocity);
    m_offset += h * m_velocity;
    const float distance = length(m_offset);
    if (distance < near_ring * m_ring)
        m_is_near = false;
    if (distance < m_ring)
        return false;
    const Vec2 out = normalize(m_offset);
    m_offset = m_ring * out;
    if (const float speed = dot(m_velocity, out); speed > 0)
        m_velocity -= (1 + ring_restitution) * speed * out;
    return !std::exchange(m_is_near, true);
}

// How far it swings, from where it is and how fast it is there.
bool TiltBob::is_still() const
{
    const float amplitude2 = dot(m_offset, m_offset) + dot(m_velocity, m_velocity) / m_stiffness;
    return amplitude2 < still_swing * still_swing * m_ring * m_ring;
}

void TiltBob::rest()
{
    m_offset = {};
    m_velocity = {};
    m_is_near = false;
}

void TiltBob::add_to(Hash& hash) const
{
    hash.add(m_offset);
    hash.add(m_velocity);
    hash.add(m_is_near);
}

// --- The cabinet -----------------------------------------------------------------------------------------------------

Cabinet::Cabinet(const CabinetDef& def) : m_def(def), m_bob(def) {}

bool Cabinet::push(Vec2 direction, double time)
{
    if (std::ranges::any_of(m_pushes, [direction](const Push& push) { return push.direction == direction; }))
        return false;
    m_pushes.push_back({direction, -time});
    return true;
}

// The speed it gives, spread over the time of the push: 30 x² (1 - x)² rises and falls smoothly and has the area 1.
Vec2 Cabinet::force_at(double time) const
{
    Vec2 sum;
    for (const Push& push : m_pushes)
    {
        const float x = static_cast<float>(push.age + time) / m_def.push_time;
        if (x > 0 && x < 1)
            sum += (30 * x * x * (1 - x) * (1 - x) / m_def.push_time) *
                   Vec2{m_def.nudge_speed.x * push.direction.x, m_def.nudge_speed.y * push.direction.y};
    }
    return sum;
}

Vec2 Cabinet::acceleration_at(double time) const
{
    const Vec2 force = force_at(time);
    const auto along = [](float push, float frequency, float damping, float offset, float velocity)
    {
        const float omega = 2 * pi * frequency;
        return push - omega * (omega * offset + 2 * damping * velocity);
    };
    return {along(force.x, m_def.frequency.x, m_def.damping.x, m_offset.x, m_velocity.x),
            along(force.y, m_def.frequency.y, m_def.damping.y, m_offset.y, m_velocity.y)};
}

bool Cabinet::step(float h)
{
    if (m_pushes.empty() && m_offset == Vec2{} && m_bob.offset() == Vec2{})
    {
        m_acceleration = {};
        return false;
    }
    const Vec2 before = m_velocity;
    const int slices = slices_of(h);
    const float slice = h / static_cast<float>(slices);
    bool touched = false;
    for (int i = 0; i < slices; ++i)
    {
        const Vec2 velocity = m_velocity;
        const double middle = (i + 0.5) * static_cast<double>(slice);
        m_offset += 0.5f * slice * m_velocity;
        m_velocity += slice * acceleration_at(middle);
        m_offset += 0.5f * slice * m_velocity;
        touched |= m_bob.step((1 / slice) * (m_velocity - velocity), slice);
    }
    for (Push& push : m_pushes)
        push.age += static_cast<double>(h);
    const double kept = std::max(static_cast<double>(m_def.push_time), hand_back);
    std::erase_if(m_pushes, [kept](const Push& push) { return push.age >= kept; });
    m_acceleration = (1 / h) * (m_velocity - before);
    come_to_rest();
    return touched;
}

void Cabinet::come_to_rest()
{
    const bool is_still = m_pushes.empty() && length(m_velocity) < still_speed && length(m_offset) < still_offset;
    if (!is_still)
        return;
    m_offset = {};
    m_velocity = {};
    if (m_bob.is_still())
        m_bob.rest();
}

void Cabinet::add_to(Hash& hash) const
{
    hash.add(m_offset);
    hash.add(m_velocity);
    for (const Push& push : m_pushes)
    {
        hash.add(push.direction);
        hash.add(push.age);
    }
    m_bob.add_to(hash);
}

} // namespace carom::pinball
