#include "pinball/player/table_camera.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

// The lowest free ball: the one that is about to matter.
double watched_height(const Game& game)
{
    double y = -1;
    for (const BallState& ball : game.balls())
        if (ball.is_free() && (y < 0 || ball.position.y < y))
            y = ball.position.y;
    return y < 0 ? 0.3 * static_cast<double>(game.table().size.y) : y;
}

} // namespace

// reach: half the height that is seen. Smoothed over a third of a second, so that the eye can follow.
double TableCamera::follow(const Game& game, double reach, double time)
{
    const Box box = cabinet_box(game.table());
    const double low = box.lower.y + reach;
    const double goal = std::clamp(watched_height(game), low, std::max(low, box.upper.y - reach));
    const double share = m_y < 0 ? 1 : 1 - std::exp(-std::max(0.0, time - m_last) / 0.3);
    m_last = time;
    m_y = m_y < 0 ? goal : m_y + (goal - m_y) * share;
    return m_y;
}

view::Camera TableCamera::look(const Game& game, const Layout& layout, double time)
{
    const Box all = cabinet_box(game.table());
    view::Camera camera = view::Camera::fit(all, layout.table.min, layout.table.max, layout.landscape ? 8.0f : 3.0f);
    if (layout.landscape || layout.side.empty())
        return camera;
    camera.points_per_meter = (layout.table.size().x - 6) / (all.upper.x - all.lower.x);
    camera.center.y = follow(game, layout.table.size().y / 2 / camera.points_per_meter, time);
    return camera;
}

} // namespace carom::pinball
