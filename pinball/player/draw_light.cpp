// Inserts in the playfield: coloured glass over lamps.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

// Two and a half flashes a second: below what is hard on the eye.
constexpr double blink_hz = 2.5;

float brightness(const Picture& picture, Index index, const Light& light)
{
    const Phase phase = picture.game.phase();
    if (phase == Phase::Attract || phase == Phase::GameOver)
    {
        // A wave that runs up the table while nobody plays.
        const double wave =
            std::sin(picture.time * 3.0 - static_cast<double>(light.pos.y) * 9.0 + static_cast<double>(light.pos.x) * 4);
        return static_cast<float>(std::clamp(0.5 + 0.7 * wave, 0.0, 1.0));
    }
    switch (picture.game.lamp(index))
    {
    case LampState::Off: return 0;
    case LampState::On: return 1;
    case LampState::Blink: return std::fmod(picture.time * blink_hz, 1.0) < 0.55 ? 1.0f : 0.12f;
    }
    return 0;
}

} // namespace

void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Light& light)
{
    const view::Color color = color_of(picture.table().elements[index], view::rgb(0xfff2c0));
    const float lit = brightness(picture, index, light);
    const view::Color dark = view::mix(view::rgb(0x10142a), color, 0.24f);
    const view::Color middle = view::mix(view::mix(dark, color, 0.25f), view::mix(color, view::rgb(0xffffff), 0.75f), lit);
    const view::Color edge = view::mix(dark, color, lit);
    canvas.fill_circle(light.pos, light.radius, view::rgb(0x070a14));
    canvas.fill_radial(light.pos, light.radius * 0.9f, middle, edge, {-0.2f, 0.25f});
    canvas.stroke_circle(light.pos, light.radius * 0.93f,
                         {view::fade(view::mix(palette::gold, color, 0.4f), 0.75f), canvas.points(0.0010f)});
    if (lit > 0.02f && !picture.plain)
        canvas.glow(light.pos, light.radius * 0.6f, light.radius * 1.9f, view::fade(color, 0.6f * lit));
    if (light.label.empty())
        return;
    view::TextStyle style{.size = canvas.points(light.radius * 1.05f),
                          .color = view::mix(view::mix(color, view::rgb(0xffffff), 0.35f), view::rgb(0x181020), lit),
                          .face = view::Face::Bold,
                          .align_x = 0.5f,
                          .align_y = 0.5f};
    const float width = canvas.camera().meters(canvas.text_size(light.label, style).x);
    style.size *= std::min(1.0f, 1.55f * light.radius / std::max(width, 1e-6f));
    canvas.text(light.pos, light.label, style);
}

} // namespace carom::pinball
