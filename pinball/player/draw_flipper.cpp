#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

namespace carom::pinball {

void draw_part(view::Canvas& canvas, const Picture& picture, Index index, const Flipper& flipper)
{
    const Pose pose = picture.game.scene().body(picture.game.element(index).body).interpolated_pose(picture.alpha);
    const Vec2 along = rotate(pose.rotation * Rotation::from_angle(flipper.rest), {1, 0});
    const Position pivot = pose.position;
    const Position tip = pivot + along * flipper.length;
    const float base = flipper.base_radius;
    const float end = flipper.tip_radius;
    canvas.fill_capsule(pivot, tip, base, end, view::rgb(0x7c1218));
    canvas.fill_capsule(pivot + Vec2{-0.0003f, 0.0004f}, tip + Vec2{-0.0003f, 0.0004f}, base * 0.93f, end * 0.9f, palette::red);
    const view::Paint ivory =
        view::Paint::linear(pivot + Vec2{-base, base}, view::rgb(0xfffaf0), pivot + Vec2{base, -base}, view::rgb(0xc9b896));
    canvas.fill_capsule(pivot, tip, base * 0.74f, end * 0.6f, ivory);
    canvas.line(pivot + along * (base * 1.1f), tip - along * (end * 0.5f),
                {view::fade(palette::teal, 0.9f), canvas.points(end * 0.34f)});
    canvas.fill_radial(pivot, base * 0.42f, palette::steel_light, palette::steel_dark, {-0.4f, 0.4f});
    const float slit = base * 0.26f;
    canvas.line(pivot - along * slit, pivot + along * slit, {palette::steel_dark, canvas.points(0.0012f)});
}

} // namespace carom::pinball
