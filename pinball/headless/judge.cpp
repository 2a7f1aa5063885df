#include "pinball/headless/judge.h"

#include <cmath>

namespace carom::pinball {

namespace {

constexpr float stuck_time = 10;    // s
constexpr float endless_time = 600; // s
constexpr float piece_angle = pi / 60;

// Corners along an arc that starts at `from`, turns by `sweep` and ends at `to`.
void add_arc(std::vector<Position>& corners, Vec2 from, Vec2 to, float sweep)
{
    const Rotation half = Rotation::from_angle(0.5f * sweep);
    const Vec2 chord = to - from;
    const Vec2 center = 0.5f * (from + to) + (0.5f * half.c / half.s) * perp(chord);
    const int pieces = static_cast<int>(std::ceil(std::abs(sweep) / piece_angle));
    for (int i = 1; i < pieces; ++i)
    {
        const float angle = sweep * static_cast<float>(i) / static_cast<float>(pieces);
        corners.emplace_back(center + rotate(Rotation::from_angle(angle), from - center));
    }
}

} // namespace

Outline::Outline(const Table& table)
{
    if (table.outline == none)
        return;
    const Chain& path = std::get<Wall>(table.elements[table.outline].part).path;
    Vec2 from = path.start;
    m_corners.emplace_back(from);
    for (const ChainPiece& piece : path.pieces)
    {
        if (piece.sweep != 0)
            add_arc(m_corners, from, piece.end, piece.sweep);
        m_corners.emplace_back(piece.end);
        from = piece.end;
    }
}

// Crossings of a ray to the right.
bool Outline::contains(Position p) const
{
    if (m_corners.empty())
        return true;
    bool inside = false;
    Position a = m_corners.back();
    for (const Position b : m_corners)
    {
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y))
            inside = !inside;
        a = b;
    }
    return inside;
}

Judge::Judge(const Table& table)
    : m_outline(table), m_lane(table), m_diameter(2 * table.ball.radius),
      m_stuck_steps(static_cast<std::int64_t>(stuck_time / table.physics.step)),
      m_endless_steps(static_cast<std::int64_t>(endless_time / table.physics.step))
{}

Verdict Judge::look(const BallState& ball, std::int64_t step)
{
    if (!m_outline.contains(ball.position))
        return Verdict::Escaped;
    if (ball.captive)
        return Verdict::Fine;
    const auto [entry, is_new] = m_watched.try_emplace(ball.serial, Watch{ball.position, step, step});
    Watch& watch = entry->second;
    const bool moved = length(ball.position - watch.from) >= m_diameter;
    if (moved || ball.held || m_lane.is_before_rod(ball.position))
    {
        watch.from = ball.position;
        watch.since = step;
    }
    if (step - watch.since >= m_stuck_steps)
        return Verdict::Stuck;
    return step - watch.first >= m_endless_steps ? Verdict::Endless : Verdict::Fine;
}

} // namespace carom::pinball
