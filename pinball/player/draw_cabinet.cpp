// The wooden cabinet and the sheet of the playfield in it.

#include "pinball/player/layout.h"
#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

namespace carom::pinball {

namespace {

using view::Paint;

void draw_wood(view::Canvas& canvas, const Table& table)
{
    const Box box = cabinet_box(table);
    const Paint wood = Paint::linear({box.lower.x, box.upper.y}, palette::wood, {box.upper.x, box.lower.y}, palette::wood_dark);
    canvas.fill_box(box, wood, 0.012f);
    canvas.push_clip(box);
    // Grain: long faint lines, closer and wider apart in turn.
    const double width = box.upper.x - box.lower.x;
    for (int i = 1; i < 46; ++i)
    {
        const double x = box.lower.x + width * (i + 0.35 * ((i * 7) % 5)) / 47;
        const float strength = 0.05f + 0.03f * static_cast<float>((i * 5) % 3);
        canvas.line({x, box.lower.y}, {x + 0.004, box.upper.y}, {view::fade(palette::wood_light, strength), 1});
    }
    canvas.pop_clip();
    canvas.stroke_box({{box.lower.x + 0.0008, box.lower.y + 0.0008}, {box.upper.x - 0.0008, box.upper.y - 0.0008}},
                      {Paint::linear({box.lower.x, box.upper.y}, view::fade(palette::wood_light, 0.9f),
                                     {box.upper.x, box.lower.y}, view::fade(palette::shadow, 0.6f)),
                       canvas.points(0.0016f)},
                      0.012f);
}

void draw_sheet(view::Canvas& canvas, const Picture& picture)
{
    const view::OutlineMesh* field = picture.art.field();
    if (field == nullptr)
        return;
    const double top = picture.table().size.y;
    const float dim = picture.plain ? 0.55f : 1;
    const auto shade = [&](view::Color c) { return view::mix(palette::room, c, dim); };
    canvas.fill_outline(*field, Paint::linear({0, top}, shade(palette::field_top), {0, 0}, shade(palette::field_bottom)));
    if (picture.plain)
        return;
    const double middle = picture.table().size.x * 0.46;
    canvas.glow({middle, top * 0.74}, 0, 0.30f, view::rgb(0x3b63c9, 0.20f));
    canvas.glow({middle, top * 0.28}, 0, 0.24f, view::rgb(0x8a3ca0, 0.15f));
}

} // namespace

void draw_cabinet(view::Canvas& canvas, const Picture& picture)
{
    draw_wood(canvas, picture.table());
    draw_sheet(canvas, picture);
}

} // namespace carom::pinball
