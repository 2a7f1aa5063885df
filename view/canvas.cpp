#include "view/canvas.h"

#include "view/mesher.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace carom::view {
namespace {

ImVec2 to_imgui(Vec2 v) { return {v.x, v.y}; }

Color color_at(const Paint& paint, Position p)
{
    if (!paint.gradient)
        return paint.from;
    const Vec2 axis = paint.end - paint.start;
    const float squared = dot(axis, axis);
    const float t = squared > 0 ? dot(p - paint.start, axis) / squared : 0;
    return mix(paint.from, paint.to, std::clamp(t, 0.0f, 1.0f));
}

std::vector<PathPoint> to_points(const Camera& camera, std::span<const Position> path, const Paint& paint)
{
    std::vector<PathPoint> points;
    points.reserve(path.size());
    for (const Position p : path)
        points.push_back({to_imgui(camera.to_screen(p)), color_at(paint, p)});
    return points;
}

float distance(ImVec2 a, ImVec2 b) { return std::hypot(a.x - b.x, a.y - b.y); }

// Points so close that the direction between them is noise would turn the line's edge inside out.
void drop_doubles(std::vector<PathPoint>& points, bool closed)
{
    const auto same = [](const PathPoint& a, const PathPoint& b) { return distance(a.at, b.at) < 0.02f; };
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
    if (closed && points.size() > 2 && same(points.front(), points.back()))
        points.pop_back();
}

float heading(ImVec2 a, ImVec2 b) { return std::atan2(b.y - a.y, b.x - a.x); }

bool is_sharp(const PathPoint& before, const PathPoint& at, const PathPoint& after, float limit)
{
    float bend = std::abs(heading(at.at, after.at) - heading(before.at, at.at));
    if (bend > pi)
        bend = 2 * pi - bend;
    return bend > limit;
}

/// Lines with round ends; corners too sharp for a miter become round joints.
class LineMaker
{
public:
    LineMaker(Mesher& mesher, Profile profile, float sharp) : m_mesher(mesher), m_profile(profile), m_sharp(sharp) {}

    void open(std::span<const PathPoint> p)
    {
        cap(p[1], p[0]);
        run(p);
        cap(p[p.size() - 2], p.back());
    }

    void closed(std::vector<PathPoint> p)
    {
        const std::size_t n = p.size();
        for (std::size_t i = 0; i < n; ++i)
        {
            if (!is_sharp(p[(i + n - 1) % n], p[i], p[(i + 1) % n], m_sharp))
                continue;
            std::rotate(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(i), p.end());
            p.push_back(p.front());
            joint(p.front());
            return run(p);
        }
        m_mesher.sweep(p, m_profile, true);
    }

private:
    void run(std::span<const PathPoint> p)
    {
        std::size_t first = 0;
        for (std::size_t i = 1; i + 1 < p.size(); ++i)
        {
            if (!is_sharp(p[i - 1], p[i], p[i + 1], m_sharp))
                continue;
            m_mesher.sweep(p.subspan(first, i + 1 - first), m_profile, false);
            joint(p[i]);
            first = i;
        }
        m_mesher.sweep(p.subspan(first), m_profile, false);
    }

    void joint(const PathPoint& at) { m_mesher.revolve(at, m_profile, 0, 2 * pi); }
    void cap(const PathPoint& inside, const PathPoint& end)
    {
        m_mesher.revolve(end, m_profile, heading(inside.at, end.at) - pi / 2, pi);
    }

    Mesher& m_mesher;
    Profile m_profile;
    float m_sharp;
};

} // namespace

OutlineMesh::OutlineMesh(std::span<const Vec2> outline) : m_outline(outline.begin(), outline.end())
{
    for (const Polygon& part : split_concave(outline))
        for (std::size_t i = 2; i < part.vertices.size(); ++i)
            m_triangles.insert(m_triangles.end(), {part.vertices[0], part.vertices[i - 1], part.vertices[i]});
}

Canvas::Canvas(ImDrawList& list, const Camera& camera, Fonts& fonts, float pixel_scale)
    : m_list(&list),
      m_camera(camera),
      m_fonts(&fonts),
      m_pixel_scale(pixel_scale)
{}

Path Canvas::world_arc(Position center, float radius, float start_angle, float sweep) const
{
    Path path;
    append_arc(path, center, radius, start_angle, sweep, tolerance());
    return path;
}

void Canvas::fill_convex(std::span<const Position> outline, const Paint& paint)
{
    auto points = to_points(m_camera, outline, paint);
    drop_doubles(points, true);
    Mesher(*m_list).convex(points, 1 / m_pixel_scale);
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
    auto edge = placed(mesh.outline());
    drop_doubles(edge, true);
    mesher.fringe(edge, 1 / m_pixel_scale);
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
    auto points = to_points(m_camera, path, pen.paint);
    drop_doubles(points, closed);
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

// ---- light --------------------------------------------------------------------------------------------------------------

namespace {

// (1 - d)² from the inner radius out: looks like light and ends without an edge.
std::vector<Profile::Step> falloff(float inner, float outer)
{
    std::vector<Profile::Step> steps;
    constexpr int count = 8;
    for (int i = 0; i <= count; ++i)
    {
        const float d = static_cast<float>(i) / count;
        steps.push_back({inner + (outer - inner) * d, (1 - d) * (1 - d)});
    }
    return steps;
}

} // namespace

void Canvas::glow(Position center, float inner_radius, float radius, Color color)
{
    begin_additive();
    const auto steps = falloff(points(inner_radius), points(inner_radius + radius));
    Mesher(*m_list).revolve({to_imgui(m_camera.to_screen(center)), color}, {steps}, 0, 2 * pi);
    end_additive();
}

void Canvas::glow_line(Position a, Position b, float radius, Color color)
{
    const std::array<Position, 2> path{a, b};
    ribbon(path, radius, color, false);
}

void Canvas::glow_path(std::span<const Position> path, float radius, Color color, bool closed)
{
    ribbon(path, radius, color, closed);
}

void Canvas::ribbon(std::span<const Position> path, float radius, Color color, bool closed)
{
    auto points_of_path = to_points(m_camera, path, color);
    drop_doubles(points_of_path, closed);
    if (points_of_path.size() < 2)
        return;
    begin_additive();
    const auto steps = falloff(0, points(radius));
    Mesher mesher(*m_list);
    // No round joints: light laid twice shines twice.
    LineMaker lines(mesher, {steps}, 10);
    if (closed && points_of_path.size() > 2)
        lines.closed(std::move(points_of_path));
    else
        lines.open(points_of_path);
    end_additive();
}

} // namespace carom::view
