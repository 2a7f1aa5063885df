// Targets: one that stands, one that falls, one on springs.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

namespace carom::pinball {

namespace {

using view::Canvas;

// A plate on edge, seen from above; `up` 1 stands, 0 lies in its slot.
void draw_plate(Canvas& canvas, Vec2 a, Vec2 b, float radius, view::Color color, float up)
{
    const float slot = radius + 0.0007f;
    canvas.fill_capsule(a, b, slot, slot, view::rgb(0x05070f, 0.9f));
    if (up <= 0.01f)
        return;
    // A standing target is nearer to the eye: it looks a little bigger and lies a little up the table.
    const Vec2 lift{-0.0010f * up, 0.0013f * up};
    canvas.fill_capsule(a, b, radius, radius, view::mix(color, palette::shadow, 0.6f));
    canvas.fill_capsule(a + lift, b + lift, radius * 1.15f, radius * 1.15f,
                        view::mix(palette::shadow, color, 0.35f + 0.65f * up));
    const Vec2 shine = lift + Vec2{-0.0003f, 0.0005f};
    canvas.line(a + shine, b + shine, {view::fade(palette::ivory, 0.75f * up), canvas.points(0.0007f)});
}

} // namespace

void draw_part(Canvas& canvas, const Picture& picture, Index index, const DropTarget& target)
{
    const view::Color color = color_of(picture.table().elements[index], palette::red);
    draw_plate(canvas, target.a, target.b, target.radius, color, 1 - picture.effects.sunk(index));
    const float glow = picture.glow(index, 0.3f);
    if (glow > 0.02f && !picture.plain)
        canvas.glow_line(target.a, target.b, 0.022f, view::fade(view::rgb(0xffb36b), 0.9f * glow));
}

void draw_part(Canvas& canvas, const Picture& picture, Index index, const Standup& target)
{
    const view::Color color = color_of(picture.table().elements[index], palette::gold);
    draw_plate(canvas, target.a, target.b, target.radius, color, 1);
    const float glow = picture.glow(index, 0.25f);
    if (glow > 0.02f && !picture.plain)
        canvas.glow_line(target.a, target.b, 0.02f, view::fade(palette::gold, 0.9f * glow));
}

void draw_part(Canvas& canvas, const Picture& picture, Index index, const SprungTarget& target)
{
    const Pose pose = picture.game.scene().body(picture.game.element(index).body).interpolated_pose(picture.alpha);
    for (const TargetSpring& spring : target.springs)
    {
        canvas.coil(spring.anchor, transform(pose, spring.local), 5, 0.006f, {palette::steel_dark, canvas.points(0.0016f)});
        canvas.coil(spring.anchor, transform(pose, spring.local), 5, 0.006f, {palette::steel_light, canvas.points(0.0008f)});
    }
    const Vec2 h = target.half;
    const Box body{pose.position - h, pose.position + h};
    const Position top{body.lower.x, body.upper.y};
    canvas.fill_box(body, view::mix(palette::red, palette::shadow, 0.55f), 0.0015f);
    const Vec2 inset{0.0008f, 0.0008f};
    canvas.fill_box({body.lower + inset, body.upper - inset},
                    view::Paint::linear(top, view::rgb(0xff7a6b), {body.upper.x, body.lower.y}, view::rgb(0xa51522)), 0.0012f);
    canvas.line(Position{body.lower.x + 0.003, body.upper.y - 0.0018}, Position{body.upper.x - 0.003, body.upper.y - 0.0018},
                {view::fade(palette::ivory, 0.8f), canvas.points(0.0009f)});
    const float glow = picture.glow(index, 0.3f);
    if (glow > 0.02f && !picture.plain)
        canvas.glow_line(body.lower, {body.upper.x, body.lower.y}, 0.03f, view::fade(palette::coral, glow));
}

} // namespace carom::pinball
