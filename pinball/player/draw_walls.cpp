// Walls, plastics and posts: what stands still.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

#include <algorithm>
#include <string>

namespace carom::pinball {

namespace {

using view::Canvas;
using view::Paint;

Box bounds(const view::Path& path)
{
    Box box{path.front(), path.front()};
    for (const Position p : path)
    {
        box.lower = {std::min(box.lower.x, p.x), std::min(box.lower.y, p.y)};
        box.upper = {std::max(box.upper.x, p.x), std::max(box.upper.y, p.y)};
    }
    return box;
}

Paint lit(const Box& box, view::Color upper_left, view::Color lower_right)
{
    return Paint::linear({box.lower.x, box.upper.y}, upper_left, {box.upper.x, box.lower.y}, lower_right);
}

view::Path shifted(view::Path path, Vec2 by)
{
    for (Position& p : path)
        p += by;
    return path;
}

struct Rail
{
    view::Color dark;
    view::Color middle;
    view::Color shine;
};

Rail rail_of(Stuff stuff)
{
    switch (stuff)
    {
    case Stuff::Metal: return {palette::steel_dark, palette::steel, palette::steel_light};
    case Stuff::Rubber: return {palette::rubber_dark, palette::rubber, view::rgb(0xffffff)};
    case Stuff::Wood: return {view::rgb(0x3a2013), view::rgb(0x8c5733), view::rgb(0xd9a873)};
    case Stuff::Plastic: return {view::rgb(0x28507a), view::rgb(0x4f8fc4), view::rgb(0xcdeaff)};
    }
    return {};
}

// A round rail: dark at its edge, bright where it faces the light.
void draw_rail(Canvas& canvas, const view::Path& path, float half, Stuff stuff, bool closed)
{
    const Rail rail = rail_of(stuff);
    canvas.polyline(path, {rail.dark, canvas.points(2 * half)}, closed);
    canvas.polyline(path, {rail.middle, canvas.points(1.5f * half)}, closed);
    const Vec2 up_left{-0.25f * half, 0.3f * half};
    canvas.polyline(shifted(path, up_left), {view::fade(rail.shine, 0.8f), std::max(0.8f, canvas.points(0.45f * half))}, closed);
}

bool is_apron(const Table& table, const view::Path& path)
{
    const double high = bounds(path).upper.y;
    return path.size() == 2 && std::ranges::any_of(table.elements,
                                                   [&](const Element& e)
                                                   {
                                                       const auto* flipper = std::get_if<Flipper>(&e.part);
                                                       return flipper != nullptr && high < static_cast<double>(flipper->pivot.y);
                                                   });
}

// A slope below the flippers covers the way of the drained balls.
void draw_apron(Canvas& canvas, const view::Path& path, const Table& table)
{
    const Position a = path.front();
    const Position b = path.back();
    const std::array<Position, 4> card{a, b, Position{b.x, 0}, Position{a.x, 0}};
    canvas.fill_polygon(card, Paint::linear({0, std::max(a.y, b.y)}, view::rgb(0x32406f), {0, 0}, view::rgb(0x141a38)));
    const Vec2 along = b - a;
    for (const float t : {0.22f, 0.30f})
    {
        const Position from = a + along * t + Vec2{0, -0.014f};
        canvas.line(from, from + along * (0.62f - t), {view::fade(palette::gold, 0.5f), canvas.points(0.0012f)});
    }
    const bool left = a.x < b.x;
    const Position low = a + along * 0.31f;
    canvas.text({low.x, low.y * 0.36},
                left ? "CAROM" : std::to_string(table.rules.balls) + (table.rules.balls == 1 ? " BALL" : " BALLS"),
                {.size = canvas.points(0.013f),
                 .color = view::fade(palette::gold, 0.85f),
                 .face = view::Face::Bold,
                 .align_x = 0.5f,
                 .align_y = 0.5f});
}

} // namespace

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Wall& wall)
{
    const view::Path& path = picture.art.path(index);
    const Stuff stuff = stuff_of(picture.table(), index);
    if (index == picture.table().outline)
    {
        if (!picture.plain)
            canvas.shade_path(shifted(path, {0.003f, -0.004f}), 0.014f, view::fade(palette::shadow, 0.7f));
        draw_rail(canvas, path, 0.0024f, stuff, false);
        return;
    }
    if (is_apron(picture.table(), path))
        draw_apron(canvas, path, picture.table());
    draw_rail(canvas, path, std::max(wall.path.half_thickness, 0.0012f), stuff, false);
}

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Solid& solid)
{
    const view::OutlineMesh* area = picture.art.area(index);
    if (area == nullptr)
        return;
    const view::Path& path = picture.art.path(index);
    const Box box = bounds(path);
    const float edge = std::max(solid.path.half_thickness, 0.0015f);
    if (stuff_of(picture.table(), index) == Stuff::Rubber)
    {
        canvas.fill_outline(*area, lit(box, view::rgb(0x6a2f3a), view::rgb(0x3a1622)));
        draw_rail(canvas, path, edge, Stuff::Rubber, true);
        return;
    }
    const view::Color base = color_of(picture.table().elements[index], view::rgb(0xa8408f));
    const float clear = picture.plain ? 0.5f : 0.94f;
    canvas.fill_outline(*area, lit(box, view::fade(view::mix(base, palette::ivory, 0.18f), clear),
                                   view::fade(view::mix(base, view::rgb(0x1a1040), 0.66f), clear)));
    canvas.polyline(path, {view::mix(base, palette::shadow, 0.55f), canvas.points(2 * edge)}, true);
    canvas.polyline(shifted(path, {-0.0004f, 0.0005f}),
                    {lit(box, view::rgb(0xffe3b0), view::mix(base, palette::shadow, 0.25f)), canvas.points(0.9f * edge)}, true);
}

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Post& post)
{
    const Rail rail = rail_of(stuff_of(picture.table(), index));
    const float glow = picture.glow(index);
    canvas.fill_circle(post.pos, post.radius, view::mix(rail.dark, rail.middle, 0.6f));
    canvas.fill_radial(post.pos, post.radius * 0.92f, rail.shine, rail.middle, {-0.35f, 0.35f});
    canvas.fill_radial(post.pos, post.radius * 0.5f, palette::steel_light, palette::steel_dark, {-0.4f, 0.4f});
    if (glow > 0.02f && !picture.plain)
        canvas.glow(post.pos, post.radius, 0.012f, view::fade(palette::ivory, 0.5f * glow));
}

} // namespace carom::pinball
