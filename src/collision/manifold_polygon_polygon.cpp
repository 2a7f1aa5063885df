// Polygon against polygon of up to eight corners, the commonest pair there is: the rules of manifold_hull_hull.cpp, with four edges tested at a
// time. Where nothing is left of the clipped edge, that file decides.

#include "collision/edge_rules.h"
#include "collision/manifold.h"
#include "core/float4.h"
#include "geometry/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

constexpr int most_corners = 8;

struct Corners
{
    Vec2 at[most_corners];
    int count;
};

struct Axis
{
    int edge = 0;
    float separation = -3e38f;
};

// x and y of four vectors; those beyond the last are the last.
void split(const Vec2* v, int first, int count, F4& x, F4& y)
{
    if (first + 4 <= count)
    {
        const F4 lo = load4(&v[first].x);
        const F4 hi = load4(&v[first + 2].x);
        x = __builtin_shufflevector(lo, hi, 0, 2, 4, 6);
        y = __builtin_shufflevector(lo, hi, 1, 3, 5, 7);
        return;
    }
    for (int i = 0; i < 4; ++i)
    {
        const Vec2 p = v[first + i < count ? first + i : count - 1];
        x[i] = p.x;
        y[i] = p.y;
    }
}

// In all lanes.
F4 greatest_of_all(F4 x)
{
    const F4 y = __builtin_shufflevector(x, x, 1, 0, 3, 2);
    const F4 two = x > y ? x : y;
    const F4 z = __builtin_shufflevector(two, two, 2, 3, 0, 1);
    return two > z ? two : z;
}

// The edge beyond which the other's corners are farthest. Four edges side by side, corner by corner.
Axis best_axis(const LeafView& reference, const Corners& other, float radii)
{
    const int count = reference.leaf->count;
    Axis best;
    for (int first = 0; first < count; first += 4)
    {
        F4 nx;
        F4 ny;
        F4 px;
        F4 py;
        split(reference.normals, first, count, nx, ny);
        split(reference.points, first, count, px, py);
        F4 low = nx * other.at[0].x + ny * other.at[0].y;
        for (int j = 1; j < other.count; ++j)
        {
            const F4 d = nx * other.at[j].x + ny * other.at[j].y;
            low = d < low ? d : low;
        }
        const F4 separation = low - (nx * px + ny * py) - radii;
        const F4 most = greatest_of_all(separation);
        if (most[0] > best.separation)
            best = {first + std::countr_zero(bits(separation == most)), most[0]};
    }
    return best;
}

// Of the edges the one that faces n most; of equals the first.
int most_opposed_edge(const LeafView& v, Vec2 n)
{
    int edge = 0;
    float most = -3e38f;
    for (int first = 0; first < v.leaf->count; first += 4)
    {
        F4 x;
        F4 y;
        split(v.normals, first, v.leaf->count, x, y);
        const F4 facing = -(x * n.x + y * n.y);
        const F4 four = greatest_of_all(facing);
        if (four[0] > most)
        {
            most = four[0];
            edge = first + std::countr_zero(bits(facing == four));
        }
    }
    return edge;
}

struct ClipPoint
{
    Vec2 core;
    int id;

    void put_between(const ClipPoint& a, const ClipPoint& b, float t) { core = a.core + t * (b.core - a.core); }
};

class PolygonPair
{
public:
    PolygonPair(const LeafView& a, const LeafView& b, const RelativePose& pose)
        : m_a(a), m_b(b), m_pose(pose), m_radii(a.leaf->r0 + b.leaf->r0)
    {
        m_corners_b.count = b.leaf->count;
        for (int i = 0; i < b.leaf->count; ++i)
            m_corners_b.at[i] = pose.to_a(b.points[i]);
    }

    // False where hull against hull must decide.
    bool collide(float margin, LocalManifold& out)
    {
        const Axis axis_a = best_axis(m_a, m_corners_b, m_radii);
        if (axis_a.separation > margin)
            return are_apart(m_a.normals[axis_a.edge], axis_a.separation, out);
        m_corners_a.count = m_a.leaf->count;
        for (int i = 0; i < m_corners_a.count; ++i)
            m_corners_a.at[i] = m_pose.to_b(m_a.points[i]);
        const Axis axis_b = best_axis(m_b, m_corners_a, m_radii);
        if (axis_b.separation > margin)
            return are_apart(-rotate(m_pose.rotation, m_b.normals[axis_b.edge]), axis_b.separation, out);
        for (int i = 0; i < m_corners_a.count; ++i)
            m_corners_a.at[i] = m_a.points[i];
        const bool flipped = edge_is_of_b(axis_a, axis_b);
        return clip_to_edge(flipped, flipped ? axis_b : axis_a, margin, out);
    }

private:
    static bool are_apart(Vec2 direction, float separation, LocalManifold& out)
    {
        out.part(direction, separation);
        return true;
    }

    // Lengths matter between near equals alone.
    [[nodiscard]] bool edge_is_of_b(const Axis& a, const Axis& b) const
    {
        const Vec2 da = edge_of(m_a, a.edge);
        const Vec2 db = edge_of(m_b, b.edge);
        const float longest = std::fabs(da.x) + std::fabs(da.y) + std::fabs(db.x) + std::fabs(db.y);
        const float lead = b.separation - a.separation;
        if (std::fabs(lead) > prefers_bias * longest)
            return lead > 0;
        return prefers_b(a.separation, std::sqrt(dot(da, da)), b.separation, std::sqrt(dot(db, db)));
    }

    static Vec2 edge_of(const LeafView& v, int edge)
    {
        return v.points[edge + 1 < v.leaf->count ? edge + 1 : 0] - v.points[edge];
    }

    // All in a's frame.
    bool clip_to_edge(bool flipped, const Axis& axis, float margin, LocalManifold& out) const
    {
        const LeafView& reference = flipped ? m_b : m_a;
        const LeafView& incident = flipped ? m_a : m_b;
        const Corners& corners = flipped ? m_corners_b : m_corners_a;
        const Corners& others = flipped ? m_corners_a : m_corners_b;
        const Vec2 n = flipped ? rotate(m_pose.rotation, reference.normals[axis.edge]) : reference.normals[axis.edge];
        const Vec2 start = corners.at[axis.edge];
        const Vec2 end = corners.at[axis.edge + 1 < corners.count ? axis.edge + 1 : 0];
        const Vec2 tangent = perp(n);
        const int i0 = most_opposed_edge(incident, flipped ? n : inverse_rotate(m_pose.rotation, n));
        const int i1 = i0 + 1 < others.count ? i0 + 1 : 0;
        ClipPoint points[2] = {{others.at[i0], i0}, {others.at[i1], i1}};
        const bool left = clip(points, tangent, dot(tangent, start)) && clip(points, -tangent, -dot(tangent, end));
        const float radius = incident.leaf->r0;
        const float offset = dot(n, start) + reference.leaf->r0 + radius;
        const bool apart = axis.separation + m_radii > 1e-6f;
        if (apart && !faces_edge(others, n, tangent, start, end))
        {
            const float d0 = dot(n, points[0].core) - offset;
            const float d1 = dot(n, points[1].core) - offset;
            const float clipped = left ? (d0 < d1 ? d0 : d1) : 3e38f;
            if (add_corners(clipped - 1e-4f * length(end - start), margin, out))
                return true;
        }
        if (!left)
            return false;
        out.normal = flipped ? -n : n;
        out.clipped = {
            {start + reference.leaf->r0 * n, end + reference.leaf->r0 * n}, {others.at[i0], others.at[i1]}, flipped, radius};
        float left_out = 3e38f;
        for (const ClipPoint& p : points)
        {
            const float separation = dot(n, p.core) - offset;
            if (separation > margin)
            {
                left_out = std::min(left_out, separation);
                if (out.count == 0)
                    std::swap(out.clipped.corners[0], out.clipped.corners[1]);
                continue;
            }
            const Vec2 on_other = p.core - radius * n;
            const Vec2 on_reference = on_other - separation * n;
            out.add(flipped ? on_other : on_reference, flipped ? on_reference : on_other, separation,
                    feature_id(flipped, axis.edge, p.id));
        }
        float third = 3e38f;
        for (int i = 0; i < others.count; ++i)
        {
            if (i != i0 && i != i1)
                third = std::min(third, dot(n, others.at[i]) - offset);
        }
        out.bound_by_third(third, left_out);
        return out.count > 0;
    }

    // Two corners may be nearest where no edge faces one. False where they are no nearer than this.
    bool add_corners(float than, float margin, LocalManifold& out) const
    {
        int a = 0;
        int b = 0;
        float nearest = 3e38f;
        for (int i = 0; i < m_corners_a.count; ++i)
        {
            for (int j = 0; j < m_corners_b.count; ++j)
            {
                const Vec2 d = m_corners_b.at[j] - m_corners_a.at[i];
                if (dot(d, d) >= nearest)
                    continue;
                nearest = dot(d, d);
                a = i;
                b = j;
            }
        }
        const float distance = std::sqrt(nearest);
        const float separation = distance - m_radii;
        if (separation >= than || !(distance > 0))
            return false;
        const Vec2 n = (1 / distance) * (m_corners_b.at[b] - m_corners_a.at[a]);
        if (separation > margin)
            return are_apart(n, separation, out);
        out.normal = n;
        out.add(m_corners_a.at[a] + m_a.leaf->r0 * n, m_corners_b.at[b] - m_b.leaf->r0 * n, separation,
                (0x4000u << 16) | (static_cast<std::uint32_t>(a) << 8) | static_cast<std::uint32_t>(b));
        out.nearest = {
            {m_corners_a.at[a], m_corners_b.at[b]},
            {corner_cone(m_a.normals, m_a.leaf->count, a), rotate(m_pose.rotation, corner_cone(m_b.normals, m_b.leaf->count, b))},
            {m_a.leaf->r0, m_b.leaf->r0}};
        return true;
    }

    // Of what is apart: is the nearest corner ahead of the edge, so that no corner of the edge is nearer to it?
    static bool faces_edge(const Corners& others, Vec2 n, Vec2 tangent, Vec2 start, Vec2 end)
    {
        Vec2 nearest = others.at[0];
        for (int i = 1; i < others.count; ++i)
            nearest = dot(n, others.at[i]) < dot(n, nearest) ? others.at[i] : nearest;
        const float along = dot(tangent, nearest);
        return along >= dot(tangent, start) && along <= dot(tangent, end);
    }

    const LeafView& m_a;
    const LeafView& m_b;
    const RelativePose& m_pose;
    float m_radii;
    Corners m_corners_a; ///< in the frame that is being looked at
    Corners m_corners_b; ///< in a's frame
};

} // namespace

void collide_polygons(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out)
{
    const bool small = a.leaf->count <= most_corners && b.leaf->count <= most_corners;
    if (!small || !PolygonPair(a, b, pose).collide(margin, out))
        collide_hull_hull(a, b, pose, margin, out);
}

} // namespace carom::internal
