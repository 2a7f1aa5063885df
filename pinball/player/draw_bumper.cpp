// Pop bumpers: yellow caps that flash.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

namespace carom::pinball {

namespace {

using view::Canvas;

// A star on the cap; each level adds points.
void draw_star(Canvas& canvas, Vec2 middle, float radius, int level, view::Color color)
{
    const int points = 5 + level;
    for (int i = 0; i < points; ++i)
    {
        const float angle = pi / 2 + static_cast<float>(i) * 2 * pi / static_cast<float>(points);
        const Vec2 out = rotate(Rotation::from_angle(angle), {1, 0});
        const std::array<Position, 3> ray{Position(middle + perp(out) * (0.3f * radius)),
                                          Position(middle - perp(out) * (0.3f * radius)), Position(middle + out * radius)};
        canvas.fill_polygon(ray, color);
    }
    canvas.fill_circle(middle, radius * 0.42f, color);
}

} // namespace

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Bumper& bumper)
{
    const float flash = picture.glow(index, 0.16f);
    const view::Color yellow = color_of(picture.table().elements[index], view::rgb(0xffd21e));
    const float r = bumper.radius;
    // The ring is pulled down while the coil is on.
    canvas.fill_circle(bumper.pos, r, palette::steel_dark);
    canvas.fill_radial(bumper.pos, r * 0.97f, palette::steel_light, palette::steel, {-0.4f, 0.4f});
    canvas.fill_circle(bumper.pos, r * (0.86f - 0.04f * flash), view::rgb(0x7a4a00));
    const view::Color inner = view::mix(view::mix(yellow, palette::ivory, 0.55f), view::rgb(0xffffff), 0.8f * flash);
    const view::Color outer = view::mix(view::mix(yellow, view::rgb(0xb36a00), 0.45f), yellow, flash);
    canvas.fill_radial(bumper.pos, r * 0.82f, inner, outer, {-0.3f, 0.35f});
    canvas.stroke_circle(bumper.pos, r * 0.66f, {view::fade(view::rgb(0x8a5200), 0.5f), canvas.points(0.0010f)});
    draw_star(canvas, bumper.pos, r * 0.46f, picture.game.bumper_level(),
              view::mix(view::rgb(0xd8343a), view::rgb(0xffffff), 0.85f * flash));
    canvas.arc(bumper.pos, r * 0.73f, 1.75f, 1.2f, {view::fade(palette::ivory, 0.85f), canvas.points(0.0016f)});
    if (flash > 0.01f && !picture.plain)
    {
        canvas.glow(bumper.pos, r * 0.5f, 0.05f, view::fade(view::rgb(0xff9a1e), 0.6f * flash));
        canvas.stroke_circle(bumper.pos, r * (1.1f + 0.7f * (1 - flash)),
                             {view::fade(yellow, 0.6f * flash), canvas.points(0.002f)});
    }
}

} // namespace carom::pinball
