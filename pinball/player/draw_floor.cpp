// Elements that lie in the playfield: rollovers, boosters, kickers, saucers.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

#include <algorithm>
#include <cmath>

namespace carom::pinball {

namespace {

using view::Canvas;

Box box_of(Vec2 pos, Vec2 half) { return {Position(pos - half), Position(pos + half)}; }

} // namespace

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Sensor& sensor)
{
    if (sensor.kills)
        return;
    const ElementState& state = picture.game.element(index);
    const float glow = std::max(state.occupied ? 1.0f : 0.0f, picture.glow(index, 0.35f));
    // A wire in a slot, along the way of the ball: across the box's long side.
    const bool upright = sensor.half.x >= sensor.half.y;
    const Vec2 along = upright ? Vec2{0, 0.011f} : Vec2{0.011f, 0};
    canvas.fill_capsule(sensor.pos - along, sensor.pos + along, 0.0030f, 0.0030f, view::rgb(0x04060d, 0.95f));
    const view::Color wire = view::mix(palette::steel, view::rgb(0xfff3c0), glow);
    canvas.line(sensor.pos - along, sensor.pos + along, {wire, canvas.points(0.0020f)});
    if (glow > 0.02f && !picture.plain)
        canvas.glow_line(sensor.pos - along, sensor.pos + along, 0.02f, view::fade(palette::gold, 0.8f * glow));
}

void draw_part(Canvas& canvas, const Picture& picture, Index, const Booster& booster)
{
    const float size = length(booster.force);
    if (size <= 0)
        return;
    const Vec2 along = booster.force * (1 / size);
    const Vec2 side = perp(along);
    const float reach = std::abs(dot(booster.half, along));
    const float wide = std::min(0.011f, std::abs(dot(booster.half, side)) * 0.6f);
    const double phase = picture.time * 1.6 - std::floor(picture.time * 1.6);
    for (int i = 0; i < 4; ++i)
    {
        const float t = (static_cast<float>(i) + static_cast<float>(phase)) / 4;
        const Vec2 tip = booster.pos + along * (reach * (2 * t - 1));
        const std::array<Position, 3> v{Position(tip - along * wide - side * wide), Position(tip),
                                        Position(tip - along * wide + side * wide)};
        const float strength = 0.7f * std::sin(pi * t);
        canvas.polyline(v, {view::fade(palette::teal, strength), canvas.points(0.0028f)});
    }
}

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Kicker& kicker)
{
    const bool lit = picture.game.element(index).lit;
    const Box box = box_of(kicker.pos, kicker.half * 0.85f);
    canvas.fill_box(box, view::rgb(0x0a0d18, 0.9f), 0.003f);
    canvas.stroke_box(box, {lit ? view::rgb(0xb78cff) : palette::steel_dark, canvas.points(0.0012f)}, 0.003f);
    const Vec2 along = normalize(kicker.kick);
    canvas.arrow(kicker.pos - along * (kicker.half.y * 0.7f), kicker.pos + along * (kicker.half.y * 0.7f),
                 {lit ? view::rgb(0xd9c2ff) : palette::steel_dark, canvas.points(0.002f)}, canvas.points(0.007f));
    const float glow = std::max(picture.glow(index, 0.3f), lit ? 0.35f : 0.0f);
    if (glow > 0.02f && !picture.plain)
        canvas.glow(kicker.pos, kicker.half.y, 0.025f, view::fade(view::rgb(0xa06bff), 0.6f * glow));
}

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Saucer& saucer)
{
    const float r = saucer.radius;
    canvas.fill_circle(saucer.pos, r * 1.28f, palette::steel_dark);
    canvas.fill_radial(saucer.pos, r * 1.24f, palette::steel_light, palette::steel, {-0.5f, 0.5f});
    canvas.fill_radial(saucer.pos, r * 1.05f, view::rgb(0x000000), view::rgb(0x262b3c), {-0.25f, 0.3f});
    const float glow = picture.glow(index, 0.4f);
    if (glow > 0.02f && !picture.plain)
        canvas.glow(saucer.pos, r, 0.03f, view::fade(palette::gold, glow));
}

} // namespace carom::pinball
