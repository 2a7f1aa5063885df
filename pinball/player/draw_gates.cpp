// One-way gates and spinners: flaps that hang over the lanes.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

using view::Canvas;

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Gate& gate)
{
    const ElementState& state = picture.game.element(index);
    const float opening = std::max(0.0f, picture.now(state.angle, state.speed));
    // A bent wire on a shaft: lifted, its foot swings out along the way of the ball.
    const Vec2 foot = gate.open_dir * (0.016f * std::sin(std::min(opening, pi / 2)) + 0.002f);
    const Vec2 across = gate.b - gate.a;
    const std::array<Position, 4> wire{gate.a + across * 0.12f, gate.a + across * 0.18f + foot, gate.a + across * 0.82f + foot,
                                       gate.a + across * 0.88f};
    canvas.polyline(wire, {palette::steel_dark, canvas.points(0.0026f)});
    canvas.polyline(wire, {palette::steel_light, canvas.points(0.0013f)});
    canvas.line(gate.a, gate.b, {palette::steel_dark, canvas.points(0.0030f)});
    canvas.line(gate.a, gate.b, {palette::steel, canvas.points(0.0018f)});
    for (const Vec2 end : {gate.a, gate.b})
        canvas.fill_radial(end, 0.0032f, palette::steel_light, palette::steel_dark, {-0.4f, 0.4f});
}

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Spinner& spinner)
{
    const ElementState& state = picture.game.element(index);
    const float angle = picture.now(state.angle, state.speed);
    const Vec2 across = spinner.b - spinner.a;
    const Vec2 normal = normalize(perp(across));
    const Vec2 a = spinner.a + across * 0.1f;
    const Vec2 b = spinner.b - across * 0.1f;
    // It hangs from its axis and is a little longer below: seen from above, its lower edge swings far, its upper one less.
    const float low = 0.013f * std::sin(angle);
    const float high = -0.009f * std::sin(angle);
    const bool front = std::cos(angle) > 0;
    const view::Color face = front ? palette::gold : palette::teal;
    const std::array<Position, 4> flag{Position(a + normal * high), Position(b + normal * high), Position(b + normal * low),
                                       Position(a + normal * low)};
    if (std::abs(low - high) > 0.0015f)
    {
        canvas.fill_polygon(flag, view::Paint::linear(flag[0], view::mix(face, palette::ivory, 0.4f), flag[2],
                                                      view::mix(face, palette::shadow, 0.4f)));
        canvas.stroke_polygon(flag, {view::fade(palette::shadow, 0.6f), canvas.points(0.0008f)});
    }
    canvas.line(spinner.a, spinner.b, {palette::steel_dark, canvas.points(0.0034f)});
    canvas.line(spinner.a, spinner.b, {palette::steel_light, canvas.points(0.0016f)});
    const float glow = picture.glow(index, 0.15f);
    if (glow > 0.02f && !picture.plain)
        canvas.glow_line(a, b, 0.022f, view::fade(palette::gold, 0.6f * glow));
}

} // namespace carom::pinball
