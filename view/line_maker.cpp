#include "view/line_maker.h"

#include <algorithm>
#include <cmath>

namespace carom::view {
namespace {

Color color_at(const Paint& paint, Position p)
{
    if (!paint.gradient)
        return paint.from;
    const Vec2 axis = paint.end - paint.start;
    const float squared = dot(axis, axis);
    const float t = squared > 0 ? dot(p - paint.start, axis) / squared : 0;
    return mix(paint.from, paint.to, std::clamp(t, 0.0f, 1.0f));
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

} // namespace

std::vector<PathPoint> to_points(const Camera& camera, std::span<const Position> path, const Paint& paint)
{
    std::vector<PathPoint> points;
    points.reserve(path.size());
    for (const Position p : path)
        points.push_back({to_imgui(camera.to_screen(p)), color_at(paint, p)});
    return points;
}

std::vector<PathPoint> to_line(const Camera& camera, std::span<const Position> path, const Paint& paint, bool closed)
{
    auto points = to_points(camera, path, paint);
    drop_doubles(points, closed);
    return points;
}

void LineMaker::open(std::span<const PathPoint> p)
{
    cap(p[1], p[0]);
    run(p);
    cap(p[p.size() - 2], p.back());
}

void LineMaker::closed(std::vector<PathPoint> p)
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

void LineMaker::run(std::span<const PathPoint> p)
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

void LineMaker::joint(const PathPoint& at) { m_mesher.revolve(at, m_profile, 0, 2 * pi); }

void LineMaker::cap(const PathPoint& inside, const PathPoint& end)
{
    m_mesher.revolve(end, m_profile, heading(inside.at, end.at) - pi / 2, pi);
}

} // namespace carom::view
