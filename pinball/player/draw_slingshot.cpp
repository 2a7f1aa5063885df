// Slingshots: a plastic with a rubber band around three posts. The kicking side bulges when the coil fires.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

namespace carom::pinball {

namespace {

using view::Canvas;

view::Path band(const Slingshot& sling, float bulge)
{
    const auto& c = sling.corners;
    const Vec2 out = normalize(-perp(c[1] - c[0]));
    view::Path path{c[0]};
    for (int i = 1; i < 8; ++i)
    {
        const float t = static_cast<float>(i) / 8;
        path.push_back(c[0] + (c[1] - c[0]) * t + out * (4 * t * (1 - t) * bulge));
    }
    path.push_back(c[1]);
    path.push_back(c[2]);
    return path;
}

} // namespace

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Slingshot& sling)
{
    const float flash = picture.glow(index, 0.06f);
    const auto& c = sling.corners;
    const Vec2 middle = (c[0] + c[1] + c[2]) * (1.0f / 3);
    canvas.fill_polygon(std::array<Position, 3>{c[0], c[1], c[2]}, view::rgb(0x231638), sling.radius * 0.5f);
    view::Path outer = band(sling, 0.007f * flash);
    canvas.polyline(outer, {palette::rubber_dark, canvas.points(2 * sling.radius)}, true);
    canvas.polyline(outer, {palette::rubber, canvas.points(1.6f * sling.radius)}, true);
    for (Position& p : outer)
        p += Vec2{-0.0008f, 0.0012f};
    canvas.polyline(outer, {view::fade(view::rgb(0xffffff), 0.7f), canvas.points(0.0014f)}, true);
    // The plastic above the band.
    std::array<Position, 3> plastic{};
    for (std::size_t i = 0; i < 3; ++i)
        plastic[i] = middle + (c[i] - middle) * 0.86f;
    const view::Color base = color_of(picture.table().elements[index], palette::coral);
    const view::Color hot = view::mix(base, palette::ivory, 0.5f * picture.glow(index));
    canvas.fill_polygon(
        plastic,
        view::Paint::linear(c[1], view::fade(hot, 0.95f), c[0], view::fade(view::mix(hot, palette::shadow, 0.45f), 0.95f)),
        0.0015f);
    canvas.stroke_polygon(plastic, {view::fade(palette::ivory, 0.6f), canvas.points(0.0010f)}, 0.0015f);
    for (const Vec2 corner : c)
        canvas.fill_radial(middle + (corner - middle) * 0.93f, 0.0034f, palette::steel_light, palette::steel_dark, {-0.4f, 0.4f});
    if (flash > 0.02f && !picture.plain)
        canvas.glow_line(c[0], c[1], 0.03f, view::fade(palette::coral, 0.9f * picture.glow(index, 0.14f)));
}

} // namespace carom::pinball
