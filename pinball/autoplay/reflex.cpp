#include "pinball/autoplay/reflex.h"

#include <cmath>

namespace carom::pinball {

namespace {

// How far ahead it sees a ball come, and the strip of the bat and the speed at which it cares.
constexpr float foresight = 0.022f; // s
constexpr float close_gap = 0.004f; // m from the face
constexpr float least_fall = 0.25f; // m/s towards the face
constexpr float near_end = 0.018f;  // m along the bat
constexpr float far_end = 0.078f;
constexpr float first_aim = 0.022f;
constexpr float last_aim = 0.058f;
constexpr float on_face = 0.008f;       // m: a ball this close rolls on the bat, or hops along it
constexpr float longest_delay = 0.012f; // s
constexpr float press_time = 0.130f;    // s
constexpr float rearm_time = 0.120f;    // s
constexpr float plunge_wait = 0.4f;     // s before a ball that lies still is launched

int steps(float seconds, float step) { return static_cast<int>(std::lround(seconds / step)); }

} // namespace

FlipperReflex::FlipperReflex(const Table& table, const Flipper& flipper, Random& random)
    : m_side(flipper.input), m_pivot(flipper.pivot), m_along(rotate(Rotation::from_angle(flipper.rest), {1, 0})),
      m_normal(flipper.up > flipper.rest ? perp(m_along) : -perp(m_along)), m_length(flipper.length),
      m_base_reach(flipper.base_radius + table.ball.radius), m_tip_reach(flipper.tip_radius + table.ball.radius),
      m_aim(random.between(first_aim, last_aim)), m_step(table.physics.step)
{}

bool FlipperReflex::step(const std::vector<BallState>& balls, Random& random)
{
    if (m_hold > 0 && m_delay == 0)
    {
        if (--m_hold == 0)
            m_rest = steps(rearm_time, m_step);
        return true;
    }
    if (m_delay > 0)
    {
        --m_delay;
        return false;
    }
    if (m_rest > 0)
    {
        --m_rest;
        return false;
    }
    for (const BallState& ball : balls)
        if (ball.is_free() && wants_to_flip(ball))
        {
            m_delay = steps(random.between(0, longest_delay), m_step);
            m_hold = steps(press_time, m_step);
            m_aim = random.between(first_aim, last_aim);
            break;
        }
    return false;
}

bool FlipperReflex::wants_to_flip(const BallState& ball) const
{
    const Vec2 p = ball.position - Position(m_pivot);
    const float along = dot(p, m_along);
    const float reach = m_base_reach + (m_tip_reach - m_base_reach) * along / m_length;
    const float gap = dot(p, m_normal) - reach;
    const float slide = dot(ball.velocity, m_along);
    const float rise = dot(ball.velocity, m_normal);
    const float soon = along + foresight * slide;
    if (gap < -m_tip_reach)
        return false; // below the bat: too late
    const bool arrives = rise < -least_fall && gap + foresight * rise < close_gap && soon > near_end && soon < far_end;
    const bool rolls_past = std::abs(gap) < on_face && std::abs(rise) <= least_fall && along >= m_aim && along < far_end;
    return arrives || rolls_past;
}

ReflexPlayer::ReflexPlayer(const Table& table, std::uint64_t seed) : m_random(seed), m_step(table.physics.step)
{
    for (const auto& element : table.elements)
    {
        if (const auto* flipper = std::get_if<Flipper>(&element.part))
            m_flippers.emplace_back(table, *flipper, m_random);
        if (const auto* plunger = std::get_if<Plunger>(&element.part))
        {
            m_lane = plunger->lane;
            m_full_pull = plunger->stroke / plunger->pull_speed;
        }
    }
}

Input ReflexPlayer::play(const Game& game)
{
    Input input;
    for (FlipperReflex& flipper : m_flippers)
        (flipper.side() == Side::Left ? input.left : input.right) |= flipper.step(game.balls(), m_random);
    input.plunger = pull(game);
    const bool idle = game.phase() == Phase::Attract || game.phase() == Phase::GameOver;
    input.start = idle && !m_start_was_down;
    m_start_was_down = input.start;
    return input;
}

// Pulls between half and all of the way: some plunges go for the lanes, others all round.
bool ReflexPlayer::pull(const Game& game)
{
    if (m_pull > 0)
        return --m_pull > 0;
    if (m_lane == none || !game.element(m_lane).occupied)
    {
        m_waited = 0;
        return false;
    }
    if (++m_waited < steps(plunge_wait, m_step))
        return false;
    m_waited = 0;
    m_pull = steps(m_full_pull * m_random.between(0.45f, 1.05f), m_step);
    return true;
}

} // namespace carom::pinball
