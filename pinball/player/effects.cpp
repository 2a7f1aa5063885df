#include "pinball/player/effects.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

constexpr float time_between_points = 0.006f; // s
constexpr std::size_t trail_points = 22;
constexpr float sink_per_step = 1.0f / 70;

Orientation::Axis cross3(const Orientation::Axis& a, const Orientation::Axis& b)
{
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Orientation::Axis unit(const Orientation::Axis& a)
{
    const float size = std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
    return {a[0] / size, a[1] / size, a[2] / size};
}

} // namespace

// First order, then made orthogonal again: steps turn by hundredths of a radian, and only the eye looks.
void Orientation::turn_by(Axis turn)
{
    for (Axis& axis : axes)
    {
        const Axis change = cross3(turn, axis);
        for (std::size_t i = 0; i < 3; ++i)
            axis[i] += change[i];
    }
    axes[0] = unit(axes[0]);
    axes[2] = unit(cross3(axes[0], axes[1]));
    axes[1] = cross3(axes[2], axes[0]);
}

Orientation::Axis Orientation::apply(Axis own) const
{
    Axis result{};
    for (std::size_t i = 0; i < 3; ++i)
        result[i] = own[0] * axes[0][i] + own[1] * axes[1][i] + own[2] * axes[2][i];
    return result;
}

void Effects::follow(const BallState& ball, const Game& game)
{
    BallMemory& memory = m_balls[ball.serial];
    const float h = game.table().physics.step;
    const float radius = game.table().ball.radius;
    memory.orientation.turn_by({-ball.rolling.y * h / radius, ball.rolling.x * h / radius, ball.spin * h});
    if (game.step_count() % std::max<std::int64_t>(std::lround(time_between_points / h), 1) != 0)
        return;
    memory.trail.insert(memory.trail.begin(), ball.position);
    if (memory.trail.size() > trail_points)
        memory.trail.pop_back();
    if (ball.held)
        memory.trail.clear();
}

void Effects::observe(const Game& game)
{
    std::erase_if(m_balls, [&](const auto& entry)
                  { return std::ranges::none_of(game.balls(), [&](const BallState& b) { return b.serial == entry.first; }); });
    for (const BallState& ball : game.balls())
        follow(ball, game);
    for (Index i = 0; i < m_sunk.size(); ++i)
    {
        const float goal = game.element(i).down ? 1.0f : 0.0f;
        m_sunk[i] += std::clamp(goal - m_sunk[i], -sink_per_step, sink_per_step);
    }
}

const BallMemory* Effects::ball(int serial) const
{
    const auto found = m_balls.find(serial);
    return found == m_balls.end() ? nullptr : &found->second;
}

float glow_of(const Game& game, Index element, float alpha, float fade_s)
{
    const std::int64_t hit = game.element(element).last_hit;
    if (hit == ElementState::never)
        return 0;
    const float age = (static_cast<float>(game.step_count() - hit) + alpha) * game.table().physics.step;
    return std::exp(-age / fade_s);
}

} // namespace carom::pinball
