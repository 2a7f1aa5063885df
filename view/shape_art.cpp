#include "view/shape_art.h"

#include <algorithm>
#include <array>
#include <type_traits>

namespace carom::view {
namespace {

/// Draws one shape; a visitor over the kinds of geometry.
struct ShapeArtist
{
    Canvas& canvas;
    const Pose& pose;
    const ShapeLook& look;

    [[nodiscard]] Position at(Vec2 local) const { return transform(pose, local); }
    [[nodiscard]] Pen edge() const { return {look.edge, look.edge_width}; }
    [[nodiscard]] bool filled() const { return look.fill.a > 0; }

    void outline(std::span<const Position> path) const
    {
        if (look.dashed)
        {
            Path loop(path.begin(), path.end());
            loop.push_back(loop.front());
            canvas.dashed(loop, edge());
        }
        else
            canvas.polyline(path, edge(), true);
    }

    // A line of real thickness, never thinner than can be seen.
    void thick(std::span<const Position> path, float half_thickness, bool closed) const
    {
        const float width = std::max(canvas.points(2 * half_thickness), look.least_thickness);
        if (look.dashed)
            canvas.dashed(path, edge());
        else if (filled())
            canvas.polyline(path, {look.fill, width}, closed);
        else
            canvas.polyline(path, edge(), closed);
    }

    void operator()(const Circle& c) const
    {
        const Position center = at(c.center);
        if (filled())
            canvas.fill_circle(center, c.radius, look.fill);
        Path path;
        append_arc(path, center, c.radius, 0, 2 * pi, canvas.tolerance());
        path.pop_back();
        outline(path);
        if (look.spoke && canvas.points(c.radius) > 3)
            canvas.line(center + rotate(pose.rotation, {0.35f * c.radius, 0}),
                        center + rotate(pose.rotation, {0.8f * c.radius, 0}), edge());
    }

    void operator()(const Polygon& p) const
    {
        Path corners;
        for (const Vec2 v : p.vertices)
            corners.push_back(at(v));
        const Path path = rounded_outline(corners, p.radius, canvas.tolerance());
        if (filled())
            canvas.fill_polygon(path, look.fill);
        outline(path);
    }

    void operator()(const Capsule& c) const
    {
        const Path path = capsule_outline(at(c.a), at(c.b), c.radius_a, c.radius_b, canvas.tolerance());
        if (filled())
            canvas.fill_polygon(path, look.fill);
        outline(path);
    }

    void operator()(const Segment& s) const
    {
        const std::array<Position, 2> path{at(s.a), at(s.b)};
        thick(path, s.half_thickness, false);
    }

    void operator()(const Arc& a) const
    {
        Path path;
        append_arc(path, at(a.center), a.radius, a.start_angle + pose.rotation.angle(), a.sweep, canvas.tolerance());
        thick(path, a.half_thickness, false);
    }

    void operator()(const Chain& c) const
    {
        Path path = chain_path(c, canvas.tolerance());
        transform_path(path, pose);
        thick(path, c.half_thickness, c.closed);
    }

    // The solid half, as far as the eye reaches.
    void operator()(const HalfSpace& h) const
    {
        const Vec2 normal = rotate(pose.rotation, normalize(h.normal));
        const Box view = canvas.camera().visible();
        const float reach = length(view.upper - view.lower);
        const Position middle = canvas.camera().center;
        const float above = dot(normal, middle - at(normalize(h.normal) * h.offset));
        const Position foot = middle - normal * above;
        const Vec2 along = perp(normal) * reach;
        const std::array<Position, 4> solid{foot - along, foot + along, foot + along - normal * (2 * reach),
                                            foot - along - normal * (2 * reach)};
        // Darker with depth: it has no end, and what is written over it stays readable.
        const Color deep = mix(look.fill, rgb(0x10141c, look.fill.a), 0.8f);
        if (filled())
            canvas.fill_polygon(solid, Paint::linear(foot, look.fill, foot - normal * (0.12f * reach), deep));
        canvas.line(solid[0], solid[1], edge());
    }
};

bool overlap(const Box& a, const Box& b)
{
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y && b.lower.y <= a.upper.y;
}

Box grown(const Box& box, float by) { return {box.lower - Vec2{by, by}, box.upper + Vec2{by, by}}; }

Color body_color(const ConstBody& body, const ScenePalette& palette)
{
    if (body.type() == BodyType::Static)
        return palette.still;
    if (body.type() == BodyType::Kinematic)
        return palette.kinematic;
    const Color color = palette.dynamic[body.id().slot % std::size(palette.dynamic)];
    return body.is_awake() ? color : mix(rgb(0x2a3242), color, palette.asleep);
}

ShapeLook shape_look(const ConstBody& body, bool trigger, const ScenePalette& palette)
{
    if (trigger)
        return {.fill = fade(palette.trigger, 0), .edge = palette.trigger, .dashed = true, .spoke = false};
    const Color color = body_color(body, palette);
    const float enabled = body.is_enabled() ? 1.0f : 0.3f;
    return {.fill = fade(color, enabled),
            .edge = fade(mix(color, rgb(0x0a0d13), 0.55f), enabled),
            .spoke = body.type() != BodyType::Static};
}

void draw_body(Canvas& canvas, const Scene& scene, BodyId id, float alpha, const ScenePalette& palette)
{
    const ConstBody body = scene.body(id);
    const Pose pose = body.interpolated_pose(alpha);
    const Box seen = grown(canvas.camera().visible(), length(body.pose().position - pose.position) + canvas.camera().meters(20));
    for (const ShapeId shape_id : body.shapes())
    {
        const ConstShape shape = scene.shape(shape_id);
        if (overlap(shape.bounds(), seen))
            draw_shape(canvas, shape.geometry(), pose, shape_look(body, shape.is_trigger(), palette));
    }
}

Position anchor(const Scene& scene, BodyId id, Vec2 local, float alpha)
{
    return id.is_null() ? Position{local} : transform(scene.body(id).interpolated_pose(alpha), local);
}

void draw_joint(Canvas& canvas, const Scene& scene, JointId id, float alpha, Color color)
{
    std::visit(
        [&](const auto& def)
        {
            using Def = std::decay_t<decltype(def)>;
            const Position a = anchor(scene, def.body_a, def.anchor_a, alpha);
            const Position b = anchor(scene, def.body_b, def.anchor_b, alpha);
            if constexpr (std::is_same_v<Def, SpringDef>)
                canvas.coil(a, b, 9, canvas.camera().meters(9), {color, 1.5f});
            else
                canvas.line(a, b, {fade(color, 0.7f), 1.5f});
            canvas.fill_circle(a, canvas.camera().meters(2.5f), color);
            canvas.fill_circle(b, canvas.camera().meters(2.5f), color);
        },
        scene.joint(id).def());
}

} // namespace

void draw_shape(Canvas& canvas, const Geometry& geometry, const Pose& pose, const ShapeLook& look)
{
    std::visit(ShapeArtist{canvas, pose, look}, geometry);
}

void draw_scene(Canvas& canvas, const Scene& scene, float alpha, const ScenePalette& palette)
{
    const std::vector<BodyId> bodies = scene.bodies();
    // Still shapes first, so that moving ones lie on top.
    for (const bool still : {true, false})
        for (const BodyId id : bodies)
            if ((scene.body(id).type() == BodyType::Static) == still)
                draw_body(canvas, scene, id, alpha, palette);
    for (const JointId id : scene.joints())
        draw_joint(canvas, scene, id, alpha, palette.joint);
}

void draw_ghost(Canvas& canvas, const Scene& scene, BodyId body, const Pose& pose, const Pen& pen)
{
    const ShapeLook look{.fill = {0, 0, 0, 0}, .edge = pen.paint.from, .edge_width = pen.width};
    for (const ShapeId shape : scene.body(body).shapes())
        draw_shape(canvas, scene.shape(shape).geometry(), pose, look);
}

} // namespace carom::view
