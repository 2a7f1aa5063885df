#include "view/canvas.h"

#include "view/line_maker.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom::view {

OutlineMesh::OutlineMesh(std::span<const Vec2> outline) : m_outline(outline.begin(), outline.end())
{
    for (const Polygon& part : split_concave(outline))
        for (std::size_t i = 2; i < part.vertices.size(); ++i)
            m_triangles.insert(m_triangles.end(), {part.vertices[0], part.vertices[i - 1], part.vertices[i]});
}

Canvas::Canvas(ImDrawList& list, const Camera& camera, Fonts& fonts, float pixel_scale)
    : m_list(&list), m_camera(camera), m_fonts(&fonts), m_pixel_scale(pixel_scale)
{}

Path Canvas::world_arc(Position center, float radius, float start_angle, float sweep) const
{
    Path path;
    append_arc(path, center, radius, start_angle, sweep, tolerance());
    return path;
}

void Canvas::fill_convex(std::span<const Position> outline, const Paint& paint)
{
    Mesher(*m_list).convex(to_line(m_camera, outline, paint, true), 1 / m_pixel_scale);
}

void Canvas::fill_circle(Position center, float radius, const Paint& paint)
{
    Path path = world_arc(center, radius, 0, 2 * pi);
    path.pop_back();
    fill_convex(path, paint);
}

void Canvas::fill_capsule(Position a, Position b, float radius_a, float radius_b, const Paint& paint)
{
    fill_convex(capsule_outline(a, b, radius_a, radius_b, tolerance()), paint);
}

void Canvas::fill_polygon(std::span<const Position> vertices, const Paint& paint, float radius)
{
    fill_convex(rounded_outline(vertices, radius, tolerance()), paint);
}

namespace {

// The corners of a box, moved inwards so that rounding gives the box back.
std::array<Position, 4> box_corners(const Box& box, float inset)
{
    const Position a = box.lower + Vec2{inset, inset};
    const Position b = box.upper - Vec2{inset, inset};
    return {Position{a.x, a.y}, Position{b.x, a.y}, Position{b.x, b.y}, Position{a.x, b.y}};
}

} // namespace

void Canvas::fill_box(const Box& box, const Paint& paint, float corner_radius)
{
    fill_polygon(box_corners(box, corner_radius), paint, corner_radius);
}

void Canvas::fill_outline(const OutlineMesh& mesh, const Paint& paint, const Pose& pose)
{
    const auto placed = [&](std::span<const Vec2> points)
    {
        Path path;
        path.reserve(points.size());
        for (const Vec2 p : points)
            path.push_back(transform(pose, p));
        return to_points(m_camera, path, paint);
    };
    Mesher mesher(*m_list);
    mesher.triangles(placed(mesh.triangles()));
    mesher.fringe(placed(mesh.outline()), 1 / m_pixel_scale);
}

void Canvas::fill_radial(Position center, float radius, Color inner, Color outer, Vec2 focus)
{
    const float flip = m_camera.y_up ? -1.0f : 1.0f;
    Mesher(*m_list).radial(to_imgui(m_camera.to_screen(center)), points(radius), {focus.x, focus.y * flip}, inner, outer,
                           1 / m_pixel_scale);
}

void Canvas::ball(Position center, float radius, Rotation rotation, Color color)
{
    const float up = m_camera.y_up ? 1.0f : -1.0f;
    const Vec2 light{-0.38f, 0.42f * up};
    fill_radial(center, radius, mix(color, rgb(0xffffff), 0.55f), mix(color, rgb(0x05070c), 0.62f), light);
    // The spot slides to the rim and grows thin, as a mark on a sphere that turns about the viewing axis would not:
    // it is a plain mark at two thirds of the radius, enough to see the spin.
    fill_circle(center + rotate(rotation, {0.62f * radius, 0}), 0.13f * radius, fade(mix(color, rgb(0x000000), 0.7f), 0.55f));
    fill_radial(center + light * radius, 0.3f * radius, rgb(0xffffff, 0.85f), rgb(0xffffff, 0));
}

void Canvas::stroke(std::span<const Position> path, const Pen& pen, bool closed)
{
    auto points = to_line(m_camera, path, pen.paint, closed);
    if (points.size() < 2)
        return;
    const float pixel = 1 / m_pixel_scale;
    const float width = std::max(pen.width, pixel);
    // Thinner than a pixel: a pixel wide and paler.
    if (pen.width < pixel)
        for (PathPoint& p : points)
            p.color = fade(p.color, pen.width / pixel);
    const std::array<Profile::Step, 2> steps{{{(width - pixel) / 2, 1}, {(width + pixel) / 2, 0}}};
    Mesher mesher(*m_list);
    LineMaker lines(mesher, {steps}, width > 3 * pixel ? 0.7f : 1.8f);
    if (closed && points.size() > 2)
        lines.closed(std::move(points));
    else
        lines.open(points);
}

void Canvas::line(Position a, Position b, const Pen& pen)
{
    const std::array<Position, 2> path{a, b};
    stroke(path, pen, false);
}

void Canvas::polyline(std::span<const Position> path, const Pen& pen, bool closed) { stroke(path, pen, closed); }

void Canvas::stroke_circle(Position center, float radius, const Pen& pen)
{
    stroke(world_arc(center, radius, 0, 2 * pi), pen, true);
}

void Canvas::stroke_capsule(Position a, Position b, float radius_a, float radius_b, const Pen& pen)
{
    stroke(capsule_outline(a, b, radius_a, radius_b, tolerance()), pen, true);
}

void Canvas::stroke_polygon(std::span<const Position> vertices, const Pen& pen, float radius)
{
    stroke(rounded_outline(vertices, radius, tolerance()), pen, true);
}

void Canvas::stroke_box(const Box& box, const Pen& pen, float corner_radius)
{
    stroke_polygon(box_corners(box, corner_radius), pen, corner_radius);
}

void Canvas::arc(Position center, float radius, float start_angle, float sweep, const Pen& pen)
{
    const bool whole = std::abs(sweep) > 2 * pi - 1e-4f;
    stroke(world_arc(center, radius, start_angle, sweep), pen, whole);
}

void Canvas::dashed(std::span<const Position> path, const Pen& pen, float dash, float gap)
{
    const float dash_m = m_camera.meters(dash);
    const float period = dash_m + m_camera.meters(gap);
    float at = 0; // where in the pattern the present piece starts
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
    {
        const Vec2 leg = path[i + 1] - path[i];
        const float size = length(leg);
        if (size <= 0 || size > 4000 * period)
            continue;
        for (float s = -at; s < size; s += period)
        {
            const float from = std::max(s, 0.0f);
            const float to = std::min(s + dash_m, size);
            if (to > from)
                line(path[i] + leg * (from / size), path[i] + leg * (to / size), pen);
        }
        at = std::fmod(at + size, period);
    }
}

void Canvas::arrow(Position from, Position to, const Pen& pen, float head)
{
    const Vec2 way = to - from;
    const float size = length(way);
    const float head_m = std::min(m_camera.meters(head), size * 0.6f);
    if (size <= 0)
        return;
    const Vec2 along = way * (1 / size);
    const Position neck = to - along * head_m;
    line(from, neck, pen);
    const std::array<Position, 3> tip{to, neck + perp(along) * (0.5f * head_m), neck - perp(along) * (0.5f * head_m)};
    fill_convex(tip, pen.paint);
}

void Canvas::coil(Position a, Position b, int turns, float width, const Pen& pen)
{
    constexpr int steps_per_turn = 16;
    const Vec2 way = b - a;
    const Vec2 side = perp(normalize(way)) * (width / 2);
    const int count = std::max(turns, 1) * steps_per_turn;
    Path path{a};
    for (int i = 0; i <= count; ++i)
    {
        const float t = static_cast<float>(i) / static_cast<float>(count);
        const float phase = 2 * pi * static_cast<float>(i) / steps_per_turn;
        path.push_back(a + way * (0.06f + 0.88f * t) + side * std::sin(phase));
    }
    path.push_back(b);
    stroke(path, pen, false);
}

void Canvas::push_clip(const Box& box)
{
    const Vec2 a = m_camera.to_screen(box.lower);
    const Vec2 b = m_camera.to_screen(box.upper);
    m_list->PushClipRect({std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}, true);
}

void Canvas::pop_clip() { m_list->PopClipRect(); }

void Canvas::text(Position at, std::string_view utf8, const TextStyle& style)
{
    const auto [font, size] = m_fonts->get(style.face, style.size);
    const Vec2 box = text_size(utf8, style);
    const Vec2 corner = m_camera.to_screen(at) - Vec2{box.x * style.align_x, box.y * style.align_y};
    const ImVec2 p{std::round(corner.x), std::round(corner.y)};
    const char* first = utf8.data();
    const char* last = first + utf8.size();
    if (style.shadow.a > 0)
        m_list->AddText(font, size, {p.x, p.y + 1}, pack(style.shadow), first, last);
    m_list->AddText(font, size, p, pack(style.color), first, last);
}

Vec2 Canvas::text_size(std::string_view utf8, const TextStyle& style) const
{
    const auto [font, size] = m_fonts->get(style.face, style.size);
    const ImVec2 box = font->CalcTextSizeA(size, 1e9f, 0, utf8.data(), utf8.data() + utf8.size());
    return {box.x, box.y};
}

} // namespace carom::view
