// The ball: polished steel that mirrors the room, with marks that show how it rolls, and a short trail.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

#include <cmath>

namespace carom::pinball {

namespace {

using view::Canvas;

void draw_marks(Canvas& canvas, Position center, float radius, const Orientation& orientation)
{
    static constexpr Orientation::Axis marks[] = {{1, 0, 0},
                                                  {-1, 0, 0},
                                                  {0, 1, 0},
                                                  {0, -1, 0},
                                                  {0, 0, 1},
                                                  {0, 0, -1},
                                                  {0.577f, 0.577f, 0.577f},
                                                  {-0.577f, 0.577f, -0.577f}};
    for (const auto& mark : marks)
    {
        const auto at = orientation.apply(mark);
        // Marks near the rim are seen at a slant; those behind are not seen.
        if (at[2] > 0.05f)
            canvas.fill_circle(center + Vec2{at[0], at[1]} * (radius * 0.9f), radius * 0.11f * (0.4f + 0.6f * at[2]),
                               view::rgb(0x1b2436, 0.5f * at[2]));
    }
}

void draw_sphere(Canvas& canvas, Position center, float radius, const Orientation* orientation)
{
    canvas.fill_circle(center, radius, view::rgb(0x10141e));
    canvas.fill_radial(center, radius * 0.965f, view::rgb(0xe8eef8), view::rgb(0x3b4454), {-0.42f, 0.46f});
    // Its reflections: the dark table from below, the bright room from above.
    canvas.fill_radial(center + Vec2{0.12f, -0.42f} * radius, radius * 0.50f, view::rgb(0x1c2b55, 0.55f),
                       view::rgb(0x1c2b55, 0.0f));
    canvas.arc(center, radius * 0.80f, -1.35f, 1.0f, {view::rgb(0xbfd4ff, 0.5f), canvas.points(radius * 0.10f)});
    if (orientation != nullptr)
        draw_marks(canvas, center, radius, *orientation);
    canvas.fill_radial(center + Vec2{-0.36f, 0.40f} * radius, radius * 0.30f, view::rgb(0xffffff), view::rgb(0xffffff, 0.0f));
}

} // namespace

void draw_balls(Canvas& canvas, const Picture& picture, bool free)
{
    const float radius = picture.table().ball.radius;
    for (const BallState& ball : picture.game.balls())
    {
        if (ball.held == free || !picture.game.scene().is_valid(ball.body))
            continue;
        const Position center =
            ball.held ? ball.position : picture.game.scene().body(ball.body).interpolated_pose(picture.alpha).position;
        const BallMemory* memory = picture.effects.ball(ball.serial);
        if (memory != nullptr && !picture.plain && length(ball.velocity) > 0.15f)
        {
            view::Path trail{center};
            trail.insert(trail.end(), memory->trail.begin(), memory->trail.end());
            canvas.trail(trail, radius * 0.85f, view::rgb(0x7fb2ff, 0.30f));
        }
        draw_sphere(canvas, center, ball.held ? radius * 0.82f : radius, memory != nullptr ? &memory->orientation : nullptr);
    }
}

} // namespace carom::pinball
