// The plunger: its spring is squeezed between the rod's head and the cabinet.

#include "pinball/player/layout.h"
#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

namespace carom::pinball {

void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Plunger& plunger)
{
    const Pose pose = picture.game.scene().body(picture.game.element(index).body).interpolated_pose(picture.alpha);
    const float travel = dot(pose.position - Position(plunger.pos), plunger.axis);
    const Vec2 axis = plunger.axis;
    const Position head = plunger.pos + axis * travel;
    const Position back = head - axis * plunger.half.y;
    // The plate that the spring leans on is just behind a rod that is pulled all the way.
    const Position plate = plunger.pos - axis * (plunger.half.y + plunger.stroke + 0.022f);
    const Vec2 side = perp(axis) * plunger.half.x;
    const Vec2 room = perp(axis) * (plunger.half.x * 1.15f);
    canvas.fill_polygon(std::array<Position, 4>{plate - room - axis * 0.004f, plate + room - axis * 0.004f,
                                                plunger.pos + room - axis * plunger.half.y,
                                                plunger.pos - room - axis * plunger.half.y},
                        view::rgb(0x090b14), 0.002f);
    canvas.line(plate - side, plate + side, {palette::steel_dark, canvas.points(0.005f)});
    canvas.line(plate - side, plate + side, {palette::steel, canvas.points(0.003f)});
    canvas.line(plate - axis * 0.008f, head, {palette::steel_dark, canvas.points(0.0056f)});
    canvas.line(plate - axis * 0.008f, head, {palette::steel_light, canvas.points(0.0028f)});
    canvas.coil(plate, back, 9, plunger.half.x * 1.5f, {view::rgb(0x20242e), canvas.points(0.0030f)});
    canvas.coil(plate, back, 9, plunger.half.x * 1.5f, {view::rgb(0xd6dde8), canvas.points(0.0016f)});
    const Vec2 corner = side + axis * plunger.half.y;
    const std::array<Position, 4> rod{head - side - axis * plunger.half.y, head + side - axis * plunger.half.y, head + corner,
                                      head - side + axis * plunger.half.y};
    canvas.fill_polygon(rod, view::Paint::linear(head + side, palette::steel_light, head - side, palette::steel_dark));
    canvas.line(head - side + axis * (plunger.half.y * 0.75f), head + side + axis * (plunger.half.y * 0.75f),
                {palette::red, canvas.points(plunger.half.y * 0.45f)});
}

} // namespace carom::pinball
