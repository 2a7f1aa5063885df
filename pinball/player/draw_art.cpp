// The print on the playfield, drawn from where the table's own parts are: rings around bumpers, arrows to the
// shots, the name between the slingshots.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace carom::pinball {

namespace {

using view::Canvas;

template <class P>
std::vector<const P*> all_of(const Table& table)
{
    std::vector<const P*> found;
    for (const Element& element : table.elements)
        if (const auto* part = std::get_if<P>(&element.part))
            found.push_back(part);
    return found;
}

void draw_rings(Canvas& canvas, const Table& table)
{
    const auto bumpers = all_of<Bumper>(table);
    if (bumpers.empty())
        return;
    Vec2 sum{};
    for (const Bumper* bumper : bumpers)
        sum += bumper->pos;
    const Vec2 middle = sum * (1 / static_cast<float>(bumpers.size()));
    for (int i = 0; i < 36; ++i)
    {
        const Vec2 ray = rotate(Rotation::from_angle(static_cast<float>(i) * pi / 18), {1, 0});
        const float from = i % 2 == 0 ? 0.03f : 0.05f;
        canvas.line(middle + ray * from, middle + ray * 0.128f, {view::fade(palette::gold, 0.10f), canvas.points(0.0022f)});
    }
    for (const float radius : {0.112f, 0.118f, 0.132f})
        canvas.stroke_circle(middle, radius, {view::fade(palette::teal, 0.28f), canvas.points(0.0012f)});
    for (const Bumper* bumper : bumpers)
    {
        canvas.fill_circle(bumper->pos, bumper->radius * 1.75f, view::fade(palette::coral, 0.16f));
        canvas.stroke_circle(bumper->pos, bumper->radius * 1.75f, {view::fade(palette::gold, 0.55f), canvas.points(0.0012f)});
    }
}

// Three chevrons that grow towards what they point at.
void draw_chevrons(Canvas& canvas, Vec2 tip, Vec2 along, view::Color color)
{
    const Vec2 side = perp(along);
    for (int i = 0; i < 3; ++i)
    {
        const float size = 0.0105f - 0.0022f * static_cast<float>(i);
        const Vec2 at = tip - along * (0.017f * static_cast<float>(i));
        const std::array<Position, 3> v{Position(at - along * size - side * size), Position(at),
                                        Position(at - along * size + side * size)};
        canvas.polyline(v, {view::fade(color, 0.75f - 0.2f * static_cast<float>(i)), canvas.points(0.0042f)});
    }
}

Vec2 flipper_middle(const Table& table)
{
    const auto flippers = all_of<Flipper>(table);
    Vec2 sum{};
    for (const Flipper* flipper : flippers)
        sum += flipper->pivot;
    return flippers.empty() ? Vec2{table.size.x / 2, 0.1f} : sum * (1 / static_cast<float>(flippers.size()));
}

void draw_shots(Canvas& canvas, const Table& table)
{
    const Vec2 from = flipper_middle(table);
    const auto point_at = [&](Vec2 at, float before, view::Color color)
    {
        const Vec2 along = normalize(at - from);
        draw_chevrons(canvas, at - along * before, along, color);
    };
    for (const Element& element : table.elements)
    {
        if (const auto* target = std::get_if<SprungTarget>(&element.part))
            point_at(target->pos, 0.028f, palette::coral);
        else if (const auto* saucer = std::get_if<Saucer>(&element.part))
            point_at(saucer->pos, 0.075f, palette::gold);
    }
    if (!table.rules.combo)
        return;
    for (const Index shot : table.rules.combo->shots)
        if (const auto* sensor = std::get_if<Sensor>(&table.elements[shot].part))
            draw_chevrons(canvas, sensor->pos - Vec2{0, 0.012f}, {0, 1}, palette::teal);
}

void draw_name(Canvas& canvas, const Table& table)
{
    std::string name = table.name;
    std::ranges::transform(name, name.begin(), [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
    const Vec2 at = flipper_middle(table) + Vec2{0, 0.098f};
    view::TextStyle style{.size = canvas.points(0.029f),
                          .color = view::fade(palette::gold, 0.92f),
                          .face = view::Face::Bold,
                          .align_x = 0.5f,
                          .align_y = 0.5f,
                          .shadow = view::fade(palette::shadow, 0.8f)};
    // Between the slingshots there are 19 cm.
    const float width = canvas.camera().meters(canvas.text_size(name, style).x);
    if (width > 0.17f)
        style.size *= 0.17f / width;
    canvas.text(at, name, style);
    for (const float side : {-1.0f, 1.0f})
        canvas.line(at + Vec2{side * 0.02f, -0.022f}, at + Vec2{side * 0.075f, -0.022f},
                    {view::Paint::linear(at + Vec2{side * 0.02f, 0}, view::fade(palette::teal, 0.9f), at + Vec2{side * 0.075f, 0},
                                         view::fade(palette::teal, 0.0f)),
                     canvas.points(0.0016f)});
    canvas.fill_circle(at + Vec2{0, -0.022f}, 0.003f, palette::coral);
}

// A ribbon under lights that belong together: the letters, the bonus.
void draw_ribbon(Canvas& canvas, const Table& table, Lamp lamp, view::Color color)
{
    view::Path path;
    float radius = 0;
    for (const Light* light : all_of<Light>(table))
        if (light->shows == lamp)
        {
            path.push_back(light->pos);
            radius = light->radius;
        }
    if (path.size() < 2)
        return;
    canvas.polyline(path, {view::fade(color, 0.13f), canvas.points(2.8f * radius)});
    canvas.polyline(path, {view::fade(color, 0.45f), canvas.points(0.0012f)});
}

// A dial in the middle of the lights below the islands: rings, ticks and two orbits.
void draw_medallion(Canvas& canvas, const Table& table)
{
    Vec2 sum{};
    float count = 0;
    for (const Light* light : all_of<Light>(table))
        if (light->shows == Lamp::Letter || light->shows == Lamp::Bonus)
        {
            sum += light->pos;
            ++count;
        }
    if (count < 2)
        return;
    const Vec2 middle = sum * (1 / count);
    const float r = 0.086f;
    canvas.fill_radial(middle, r, view::rgb(0x8a3f9d, 0.70f), view::rgb(0x1a2560, 0.55f));
    for (const float ring : {1.0f, 0.955f, 0.62f})
        canvas.stroke_circle(middle, r * ring, {view::fade(palette::gold, 0.6f), canvas.points(0.0011f)});
    for (int i = 0; i < 72; ++i)
    {
        const Vec2 out = rotate(Rotation::from_angle(static_cast<float>(i) * pi / 36), {1, 0});
        const float from = i % 6 == 0 ? 0.87f : 0.915f;
        canvas.line(middle + out * (r * from), middle + out * (r * 0.945f),
                    {view::fade(palette::gold, 0.5f), canvas.points(0.0009f)});
    }
    for (const float tilt : {0.5f, -0.5f})
    {
        view::Path orbit;
        for (int i = 0; i < 72; ++i)
        {
            const Vec2 unit = rotate(Rotation::from_angle(static_cast<float>(i) * pi / 36), {1, 0});
            orbit.push_back(middle + rotate(Rotation::from_angle(tilt), {unit.x * r * 0.60f, unit.y * r * 0.22f}));
        }
        canvas.polyline(orbit, {view::fade(palette::teal, 0.55f), canvas.points(0.0014f)}, true);
        canvas.fill_circle(orbit[9], 0.0042f, palette::coral);
    }
    canvas.fill_radial(middle, 0.011f, view::rgb(0xffe9a8), palette::gold, {-0.3f, 0.3f});
}

} // namespace

void draw_art(Canvas& canvas, const Picture& picture)
{
    if (picture.plain)
        return;
    const Table& table = picture.table();
    draw_medallion(canvas, table);
    draw_ribbon(canvas, table, Lamp::Letter, palette::coral);
    draw_ribbon(canvas, table, Lamp::Bonus, palette::teal);
    draw_rings(canvas, table);
    draw_shots(canvas, table);
    draw_name(canvas, table);
}

} // namespace carom::pinball
