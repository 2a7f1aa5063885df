// Concave outlines to convex polygons: ear clipping, then triangles are merged over shared diagonals while the result stays convex
// (the method of Hertel and Mehlhorn: never more than four times the least number of pieces).

#include "carom/shape.h"
#include "core/refuse.h"
#include "geometry/leaf.h"

#include <algorithm>

namespace carom {

namespace {

using Loop = std::vector<int>;

struct Outline
{
    std::vector<Vec2> points;

    [[nodiscard]] double turn(int a, int b, int c) const
    {
        const Vec2 pa = at(a);
        const Vec2 pb = at(b);
        const Vec2 pc = at(c);
        return (static_cast<double>(pb.x) - pa.x) * (static_cast<double>(pc.y) - pb.y) -
               (static_cast<double>(pb.y) - pa.y) * (static_cast<double>(pc.x) - pb.x);
    }
    [[nodiscard]] Vec2 at(int i) const { return points[static_cast<std::size_t>(i)]; }
};

bool segments_cross(const Outline& o, int a, int b, int c, int d)
{
    return (o.turn(a, b, c) > 0) != (o.turn(a, b, d) > 0) && (o.turn(c, d, a) > 0) != (o.turn(c, d, b) > 0);
}

bool crosses_itself(const Outline& o)
{
    const int n = static_cast<int>(o.points.size());
    for (int i = 0; i < n; ++i)
    {
        for (int j = i + 2; j < n; ++j)
        {
            if ((j + 1) % n != i && segments_cross(o, i, (i + 1) % n, j, (j + 1) % n))
                return true;
        }
    }
    return false;
}

bool is_ear(const Outline& o, const Loop& loop, std::size_t i)
{
    const std::size_t n = loop.size();
    const int a = loop[(i + n - 1) % n];
    const int b = loop[i];
    const int c = loop[(i + 1) % n];
    if (o.turn(a, b, c) <= 0)
        return false;
    return std::none_of(
        loop.begin(), loop.end(), [&](int p)
        { return p != a && p != b && p != c && o.turn(a, b, p) >= 0 && o.turn(b, c, p) >= 0 && o.turn(c, a, p) >= 0; });
}

std::vector<Loop> clip_ears(const Outline& o)
{
    Loop rest;
    for (int i = 0; i < static_cast<int>(o.points.size()); ++i)
        rest.push_back(i);
    std::vector<Loop> triangles;
    while (rest.size() > 3)
    {
        std::size_t ear = 0;
        while (ear < rest.size() && !is_ear(o, rest, ear))
            ++ear;
        if (ear == rest.size())
            break; // only points in line are left
        const std::size_t n = rest.size();
        triangles.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(ear));
    }
    if (rest.size() == 3 && o.turn(rest[0], rest[1], rest[2]) > 0)
        triangles.push_back(rest);
    return triangles;
}

bool is_convex_loop(const Outline& o, const Loop& loop)
{
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i)
    {
        if (o.turn(loop[i], loop[(i + 1) % n], loop[(i + 2) % n]) <= 0)
            return false;
    }
    return true;
}

// The union of two loops over the edge that a runs forwards and b backwards; empty where they share none.
Loop join(const Loop& a, const Loop& b)
{
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        for (std::size_t j = 0; j < b.size(); ++j)
        {
            if (a[i] != b[(j + 1) % b.size()] || a[(i + 1) % a.size()] != b[j])
                continue;
            Loop joined;
            for (std::size_t k = 1; k <= a.size(); ++k)
                joined.push_back(a[(i + k) % a.size()]);
            for (std::size_t k = 2; k < b.size(); ++k)
                joined.push_back(b[(j + k) % b.size()]);
            return joined;
        }
    }
    return {};
}

bool merge_one(const Outline& o, std::vector<Loop>& loops)
{
    for (std::size_t i = 0; i < loops.size(); ++i)
    {
        for (std::size_t j = i + 1; j < loops.size(); ++j)
        {
            Loop joined = join(loops[i], loops[j]);
            if (joined.empty() || !is_convex_loop(o, joined))
                continue;
            loops[i] = std::move(joined);
            loops.erase(loops.begin() + static_cast<std::ptrdiff_t>(j));
            return true;
        }
    }
    return false;
}

} // namespace

std::vector<Polygon> split_concave(std::span<const Vec2> outline)
{
    const internal::Checker check{"split_concave"};
    for (Vec2 p : outline)
    {
        if (!check.finite("outline", p))
            return {};
    }
    Outline o{internal::clean_outline(outline, 1e-6f)};
    if (!check.holds(o.points.size() >= 3, "outline", std::to_string(o.points.size()) + " distinct corners",
                     "must have at least 3"))
        return {};
    if (!check.holds(!crosses_itself(o), "outline", "an outline that crosses itself", "must be simple"))
        return {};
    std::vector<Loop> loops = clip_ears(o);
    while (merge_one(o, loops))
    {
    }
    std::vector<Polygon> polygons;
    for (const Loop& loop : loops)
    {
        Polygon polygon;
        for (int i : loop)
            polygon.vertices.push_back(o.at(i));
        polygons.push_back(std::move(polygon));
    }
    return polygons;
}

} // namespace carom
