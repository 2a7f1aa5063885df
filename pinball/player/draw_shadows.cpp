// Soft shadows of what stands on the playfield: they give it height.

#include "pinball/player/palette.h"
#include "pinball/player/parts.h"

namespace carom::pinball {

namespace {

using view::Canvas;

constexpr Vec2 away{0.0045f, -0.0055f}; // from the light, for things as high as a ball's middle

view::Color dark(float strength) { return view::fade(palette::shadow, strength); }

void shadow_of_path(Canvas& canvas, view::Path path, float radius, bool closed)
{
    for (Position& p : path)
        p += away;
    canvas.shade_path(path, radius, dark(0.75f), closed);
}

void shadow_of_line(Canvas& canvas, Position a, Position b, float radius) { shadow_of_path(canvas, {a, b}, radius, false); }

struct Caster
{
    Canvas& canvas;
    const Picture& picture;
    Index index;

    void operator()(const Wall& wall) const
    {
        shadow_of_path(canvas, picture.art.path(index), wall.path.half_thickness + 0.009f, false);
    }
    void operator()(const Solid&) const
    {
        const view::OutlineMesh* area = picture.art.area(index);
        if (area == nullptr)
            return;
        canvas.fill_outline(*area, dark(0.42f), {.position = Position(away)});
        shadow_of_path(canvas, picture.art.path(index), 0.010f, true);
    }
    void operator()(const Post& post) const { canvas.shade(post.pos + away, post.radius * 0.6f, 0.007f, dark(0.7f)); }
    void operator()(const Bumper& bumper) const { canvas.shade(bumper.pos + 2 * away, bumper.radius, 0.012f, dark(0.75f)); }
    void operator()(const Slingshot& sling) const
    {
        const std::array<Position, 3> corners{sling.corners[0] + away, sling.corners[1] + away, sling.corners[2] + away};
        canvas.fill_polygon(corners, dark(0.45f), sling.radius);
        // Along the rounded outline: about a sharp corner a soft edge would grow a spike.
        canvas.shade_path(view::rounded_outline(corners, sling.radius, canvas.tolerance()), 0.009f, dark(0.7f), true);
    }
    void operator()(const Flipper& flipper) const
    {
        const Pose pose = picture.game.scene().body(picture.game.element(index).body).interpolated_pose(picture.alpha);
        const Vec2 tip = rotate(pose.rotation * Rotation::from_angle(flipper.rest), {flipper.length, 0});
        shadow_of_line(canvas, flipper.pivot, flipper.pivot + tip, flipper.base_radius + 0.006f);
    }
    void operator()(const SprungTarget& target) const
    {
        const Vec2 half{target.half.x, 0};
        shadow_of_line(canvas, target.pos - half, target.pos + half, target.half.y + 0.007f);
    }
    void operator()(const DropTarget& target) const
    {
        const float up = 1 - picture.effects.sunk(index);
        if (up > 0.3f)
            shadow_of_line(canvas, target.a, target.b, 0.008f * up);
    }
    void operator()(const Standup& target) const { shadow_of_line(canvas, target.a, target.b, 0.008f); }
    void operator()(const auto&) const {}
};

} // namespace

void draw_shadows(Canvas& canvas, const Picture& picture)
{
    if (picture.plain)
        return;
    const auto& elements = picture.table().elements;
    for (Index i = 0; i < elements.size(); ++i)
        if (elements[i].visible)
            std::visit(Caster{canvas, picture, i}, elements[i].part);
    for (const BallState& ball : picture.game.balls())
        if (!ball.held && picture.game.scene().is_valid(ball.body))
        {
            const Pose pose = picture.game.scene().body(ball.body).interpolated_pose(picture.alpha);
            const float radius = picture.table().ball.radius;
            canvas.shade(pose.position + away, radius * 0.55f, radius * 0.75f, dark(0.9f));
        }
}

} // namespace carom::pinball
