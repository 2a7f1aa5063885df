#pragma once

/// @file
/// Anti-aliased drawing in world metres (or in window points, with Camera::screen). Short-lived: get one from a Window
/// in every frame. Widths of lines and sizes of text are in points; everything else is in the camera's world.

#include "view/camera.h"
#include "view/color.h"
#include "view/fonts.h"
#include "view/path.h"

#include <span>
#include <string_view>
#include <vector>

struct ImDrawList;

namespace carom::view {

/// A filled area of any simple outline, cut into triangles once. Points in the outline's own frame.
class OutlineMesh
{
public:
    /// Either winding. Throws carom::Error where the outline crosses itself.
    explicit OutlineMesh(std::span<const Vec2> outline);
    [[nodiscard]] std::span<const Vec2> outline() const { return m_outline; }     ///< counter-clockwise
    [[nodiscard]] std::span<const Vec2> triangles() const { return m_triangles; } ///< three points each

private:
    std::vector<Vec2> m_outline;
    std::vector<Vec2> m_triangles;
};

/// How text stands at its point: 0 left or top, 0.5 in the middle, 1 right or bottom.
struct TextStyle
{
    float size = 15; ///< points
    Color color{};
    Face face = Face::Sans;
    float align_x = 0;
    float align_y = 0;
    Color shadow = {0, 0, 0, 0}; ///< drawn one point below, where its alpha is not 0
};

class Canvas
{
public:
    Canvas(ImDrawList& list, const Camera& camera, Fonts& fonts, float pixel_scale);

    [[nodiscard]] const Camera& camera() const { return m_camera; }
    [[nodiscard]] float points(float meters) const { return m_camera.points(meters); }
    /// How far a chord may lie from its curve so that no eye sees it, in metres of the camera's world.
    [[nodiscard]] float tolerance() const { return m_camera.meters(0.12f / m_pixel_scale); }
    [[nodiscard]] ImDrawList& list() const { return *m_list; }

    // Areas.
    void fill_circle(Position center, float radius, const Paint& paint);
    void fill_capsule(Position a, Position b, float radius_a, float radius_b, const Paint& paint);
    /// Convex; corners rounded outwards by radius.
    void fill_polygon(std::span<const Position> vertices, const Paint& paint, float radius = 0);
    void fill_box(const Box& box, const Paint& paint, float corner_radius = 0);
    void fill_outline(const OutlineMesh& mesh, const Paint& paint, const Pose& pose = {});
    /// From inner to outer colour; focus moves the inner colour's place (-1 to 1 of the radius).
    void fill_radial(Position center, float radius, Color inner, Color outer, Vec2 focus = {});
    /// A polished ball lit from the upper left, with a spot that shows how it turns.
    void ball(Position center, float radius, Rotation rotation, Color color);

    // Lines. Round ends and joints.
    void line(Position a, Position b, const Pen& pen);
    void polyline(std::span<const Position> path, const Pen& pen, bool closed = false);
    void stroke_circle(Position center, float radius, const Pen& pen);
    void stroke_capsule(Position a, Position b, float radius_a, float radius_b, const Pen& pen);
    void stroke_polygon(std::span<const Position> vertices, const Pen& pen, float radius = 0);
    void stroke_box(const Box& box, const Pen& pen, float corner_radius = 0);
    void arc(Position center, float radius, float start_angle, float sweep, const Pen& pen);
    void dashed(std::span<const Position> path, const Pen& pen, float dash = 6, float gap = 5);
    void arrow(Position from, Position to, const Pen& pen, float head = 9);
    /// A coil spring drawn between two points; width in metres.
    void coil(Position a, Position b, int turns, float width, const Pen& pen);

    // Light. Added to what is below, so that it shines; fades to nothing at radius beyond the shape.
    void glow(Position center, float inner_radius, float radius, Color color);
    void glow_line(Position a, Position b, float radius, Color color);
    void glow_path(std::span<const Position> path, float radius, Color color, bool closed = false);
    /// The trail of a moving thing: the path from its newest point to its oldest, ever thinner and fainter.
    void trail(std::span<const Position> newest_first, float radius, Color color);
    /// Everything drawn between the two calls is added as light.
    void begin_additive();
    void end_additive();

    // Shade. The same soft edges, laid over what is below: shadows that give depth.
    void shade(Position center, float inner_radius, float radius, Color color);
    void shade_path(std::span<const Position> path, float radius, Color color, bool closed = false);

    // Text.
    void text(Position at, std::string_view utf8, const TextStyle& style);
    [[nodiscard]] Vec2 text_size(std::string_view utf8, const TextStyle& style) const; ///< points

    /// Nothing is drawn outside the box until pop_clip.
    void push_clip(const Box& box);
    void pop_clip();

private:
    [[nodiscard]] Path world_arc(Position center, float radius, float start_angle, float sweep) const;
    void fill_convex(std::span<const Position> outline, const Paint& paint);
    void stroke(std::span<const Position> path, const Pen& pen, bool closed);

    ImDrawList* m_list;
    Camera m_camera;
    Fonts* m_fonts;
    float m_pixel_scale;
    int m_additive = 0;
};

} // namespace carom::view
