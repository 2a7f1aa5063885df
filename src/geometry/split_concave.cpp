// Splits concave outlines into convex polygons: ear clipping, then triangles are merged over shared diagonals while the result stays convex
// (the method of Hertel and Mehlhorn: never more than four times the least number of pieces).

#include "carom/shape.h"
#include "core/refuse.h"
#include "geometry/leaf.h"

#include <algorithm>
#include <map>
#include <utility>

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

/// The remaining corners of an outline, and for each whether it is an ear. Cutting off an ear unblocks other corners and changes its two neighbors.
class Ears
{
public:
    explicit Ears(const Outline& o) : m_outline(o), m_blockers(o.points.size(), unknown)
    {
        for (int i = 0; i < static_cast<int>(o.points.size()); ++i)
            m_rest.push_back(i);
    }

    /// The next triangle, or an empty loop where none is left.
    Loop cut()
    {
        std::size_t ear = 0;
        while (ear < m_rest.size() && !is_ear(ear))
            ++ear;
        if (ear == m_rest.size())
            return {}; // only collinear points are left
        const Loop triangle = m_rest.size() == 3 ? m_rest : Loop{before(ear), m_rest[ear], after(ear)};
        for (const int neighbour : {before(ear), after(ear)})
            blocker(neighbour) = unknown;
        blocker(m_rest[ear]) = gone;
        m_rest.erase(m_rest.begin() + static_cast<std::ptrdiff_t>(ear));
        return triangle;
    }

private:
    static constexpr int unknown = -1;
    static constexpr int nobody = -2;
    static constexpr int gone = -3;
    static constexpr int itself = -4; ///< the corner is reflex or flat

    [[nodiscard]] int before(std::size_t i) const { return m_rest[(i + m_rest.size() - 1) % m_rest.size()]; }
    [[nodiscard]] int after(std::size_t i) const { return m_rest[(i + 1) % m_rest.size()]; }
    [[nodiscard]] double turn_at(std::size_t i) const { return m_outline.turn(before(i), m_rest[i], after(i)); }
    int& blocker(int corner) { return m_blockers[static_cast<std::size_t>(corner)]; }

    // A corner that was found inside the triangle stays inside until it is cut off itself.
    bool is_ear(std::size_t i)
    {
        int& found = blocker(m_rest[i]);
        if (found == unknown || (found >= 0 && blocker(found) == gone))
            found = turn_at(i) <= 0 ? itself : who_blocks(i);
        return found == nobody;
    }

    [[nodiscard]] int who_blocks(std::size_t i) const
    {
        const Outline& o = m_outline;
        const int a = before(i);
        const int b = m_rest[i];
        const int c = after(i);
        for (const int p : m_rest)
        {
            if (p != a && p != b && p != c && o.turn(a, b, p) >= 0 && o.turn(b, c, p) >= 0 && o.turn(c, a, p) >= 0)
                return p;
        }
        return nobody;
    }

    const Outline& m_outline;
    Loop m_rest;
    std::vector<int> m_blockers; ///< by corner
};

std::vector<Loop> clip_ears(const Outline& o)
{
    std::vector<Loop> triangles;
    Ears ears(o);
    for (Loop triangle = ears.cut(); !triangle.empty(); triangle = ears.cut())
        triangles.push_back(triangle);
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

// The union of two loops over an edge that a traverses forwards and b backwards; empty where they share none.
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

/// Joins loops over shared edges while the result stays convex: always the first loop with the first that it can be joined with.
class Merger
{
public:
    Merger(const Outline& o, std::vector<Loop> loops) : m_outline(o), m_loops(std::move(loops))
    {
        for (std::size_t i = 0; i < m_loops.size(); ++i)
            take_edges(i);
    }

    std::vector<Loop> merge()
    {
        // A loop that could not be joined may become joinable with one that has grown, so the earlier loops are tried again.
        for (std::size_t i = 0; i < m_loops.size();)
            i = grow(i) ? first_around(i) : i + 1;
        std::erase_if(m_loops, [](const Loop& loop) { return loop.empty(); });
        return std::move(m_loops);
    }

private:
    using Edge = std::pair<int, int>;

    void take_edges(std::size_t i)
    {
        const Loop& loop = m_loops[i];
        for (std::size_t k = 0; k < loop.size(); ++k)
            m_left_of[{loop[k], loop[(k + 1) % loop.size()]}] = i;
    }

    // The loops on the other side of its edges, in order of their indices.
    [[nodiscard]] std::vector<std::size_t> neighbours(std::size_t i) const
    {
        std::vector<std::size_t> found;
        const Loop& loop = m_loops[i];
        for (std::size_t k = 0; k < loop.size(); ++k)
        {
            const auto other = m_left_of.find({loop[(k + 1) % loop.size()], loop[k]});
            if (other != m_left_of.end())
                found.push_back(other->second);
        }
        std::ranges::sort(found);
        return found;
    }

    bool grow(std::size_t i)
    {
        for (const std::size_t j : neighbours(i))
        {
            Loop joined = j > i ? join(m_loops[i], m_loops[j]) : Loop{};
            if (joined.empty() || !is_convex_loop(m_outline, joined))
                continue;
            m_loops[i] = std::move(joined);
            m_loops[j].clear();
            take_edges(i);
            return true;
        }
        return false;
    }

    [[nodiscard]] std::size_t first_around(std::size_t i) const
    {
        const std::vector<std::size_t> around = neighbours(i);
        return around.empty() ? i : std::min(i, around.front());
    }

    const Outline& m_outline;
    std::vector<Loop> m_loops;             ///< empty: joined with an earlier one
    std::map<Edge, std::size_t> m_left_of; ///< the loop that runs along an edge
};

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
    std::vector<Polygon> polygons;
    for (const Loop& loop : Merger(o, clip_ears(o)).merge())
    {
        Polygon polygon;
        for (int i : loop)
            polygon.vertices.push_back(o.at(i));
        polygons.push_back(std::move(polygon));
    }
    return polygons;
}

} // namespace carom
