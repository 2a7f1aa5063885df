// Convex outlines of up to eight corners with one radius, the most common pairs: polygons, capsules, segments and pieces of chains. The rules are those of
// manifold_hull_hull.cpp, with four edges tested at a time. Where nothing is left of the clipped edge, that file decides.

#include "collision/edge_rules.h"
#include "collision/hull.h"
#include "collision/manifold.h"
#include "core/float4.h"

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

bool is_outline(const Leaf& leaf) { return leaf.type == LeafType::Polygon ? leaf.count <= most_corners : leaf.r0 == leaf.r1; }

struct EdgeAxis
{
    int edge = 0;
    float separation = -3e38f;
};

// x and y of four vectors; lanes beyond the last vector repeat it.
void split(const Vec2* v, int first, int count, F4& x, F4& y)
{
    if (first + 4 <= count)
    {
        const F4 lo = load4(&v[first].x);
        const F4 hi = load4(&v[first + 2].x);
        x = even_lanes(lo, hi);
        y = odd_lanes(lo, hi);
        return;
    }
    const auto at = [&](int i) { return v[std::min(first + i, count - 1)]; };
    x = four_of(at(0).x, at(1).x, at(2).x, at(3).x);
    y = four_of(at(0).y, at(1).y, at(2).y, at(3).y);
}

// The greatest of the four lanes, in all lanes.
F4 greatest_of_all(F4 x)
{
    const F4 two = greatest(x, swapped_neighbours(x));
    return greatest(two, swapped_halves(two));
}

// The edge of greatest separation from the other's corners. Four edges are tested side by side, corner by corner.
EdgeAxis best_axis(const Hull& reference, const Corners& other, float radii)
{
    const int count = reference.count();
    EdgeAxis best;
    for (int first = 0; first < count; first += 4)
    {
        F4 nx;
        F4 ny;
        F4 px;
        F4 py;
        split(reference.normals(), first, count, nx, ny);
        split(reference.points(), first, count, px, py);
        F4 low = nx * other.at[0].x + ny * other.at[0].y;
        for (int j = 1; j < other.count; ++j)
        {
            const F4 d = nx * other.at[j].x + ny * other.at[j].y;
            low = least(d, low);
        }
        const F4 separation = low - (nx * px + ny * py) - radii;
        const F4 most = greatest_of_all(separation);
        if (first_lane(most) > best.separation)
            best = {first + std::countr_zero(bits(separation == most)), first_lane(most)};
    }
    return best;
}

// The edge that faces n most; of equal ones the first.
int most_opposed_edge(const Hull& v, Vec2 n)
{
    int edge = 0;
    float most = -3e38f;
    for (int first = 0; first < v.count(); first += 4)
    {
        F4 x;
        F4 y;
        split(v.normals(), first, v.count(), x, y);
        const F4 facing = -(x * n.x + y * n.y);
        const F4 four = greatest_of_all(facing);
        if (first_lane(four) > most)
        {
            most = first_lane(four);
            edge = first + std::countr_zero(bits(facing == four));
        }
    }
    return edge;
}

struct OutlinePoint
{
    Vec2 core;
    int id;

    void put_between(const OutlinePoint& a, const OutlinePoint& b, float t) { core = a.core + t * (b.core - a.core); }
};

class OutlinePair
{
public:
    OutlinePair(const Hull& a, const Hull& b, const RelativePose& pose)
        : m_a(a), m_b(b), m_pose(pose), m_radii(a.radius(0) + b.radius(0))
    {
        m_corners_b.count = b.count();
        for (int i = 0; i < b.count(); ++i)
            m_corners_b.at[i] = pose.to_a(b.point(i));
    }

    // False where collide_hull_hull must decide.
    bool collide(float margin, LocalManifold& out)
    {
        const EdgeAxis axis_a = best_axis(m_a, m_corners_b, m_radii);
        if (axis_a.separation > margin)
            return are_apart(m_a.normal(axis_a.edge), axis_a.separation, out);
        m_corners_a.count = m_a.count();
        for (int i = 0; i < m_corners_a.count; ++i)
            m_corners_a.at[i] = m_pose.to_b(m_a.point(i));
        const EdgeAxis axis_b = best_axis(m_b, m_corners_a, m_radii);
        if (axis_b.separation > margin)
            return are_apart(-rotate(m_pose.rotation, m_b.normal(axis_b.edge)), axis_b.separation, out);
        for (int i = 0; i < m_corners_a.count; ++i)
            m_corners_a.at[i] = m_a.point(i);
        const bool flipped = edge_is_of_b(axis_a, axis_b);
        return clip_to_edge(flipped, flipped ? axis_b : axis_a, margin, out);
    }

    // Rules for b as a piece of a chain, once points are found: only its solid side touches, and a normal that leans over a seam becomes the piece's own.
    void keep_to_piece(const Leaf& piece, float margin, LocalManifold& out) const
    {
        const Vec2 tangent = rotate(m_pose.rotation, perp(m_b.normal(0)));
        const float side = cross(tangent, m_a.center() - m_corners_b.at[0]);
        const Vec2 center = m_pose.to_b(m_a.center());
        if (is_beside_solid_side(piece, static_cast<double>(side)) || is_behind_seam(piece, side, center))
            out.count = 0;
        if (out.count == 0 || !leans_over_seam(piece, -out.normal, tangent, m_pose.rotation))
            return;
        out.count = 0;
        out.clipped.radius = -1;
        const Facing own(*this, true, side > 0 ? 1 : 0);
        if (own.left) // otherwise no part of the outline is before the piece: beyond the seam the contact belongs to the neighbor
            own.add_points(margin, out);
    }

private:
    // An edge of one outline, and the part of the other's most opposed edge that is before it. All in a's frame.
    struct Facing
    {
        bool flipped; // the edge is b's
        int edge;
        const Hull& reference;
        const Hull& incident;
        const Corners& others;
        Vec2 n;
        Vec2 tangent;
        Vec2 start;
        Vec2 end;
        float offset;
        int i0;
        int i1;
        OutlinePoint points[2];
        bool left; // whether clipping left anything

        Facing(const OutlinePair& pair, bool is_flipped, int of_edge)
            : flipped(is_flipped), edge(of_edge), reference(flipped ? pair.m_b : pair.m_a),
              incident(flipped ? pair.m_a : pair.m_b), others(flipped ? pair.m_corners_a : pair.m_corners_b)
        {
            const Corners& corners = flipped ? pair.m_corners_b : pair.m_corners_a;
            const Rotation turn = pair.m_pose.rotation;
            n = flipped ? rotate(turn, reference.normal(edge)) : reference.normal(edge);
            tangent = perp(n);
            start = corners.at[edge];
            end = corners.at[reference.next(edge)];
            offset = dot(n, start) + reference.radius(0) + incident.radius(0);
            i0 = most_opposed_edge(incident, flipped ? n : inverse_rotate(turn, n));
            i1 = incident.next(i0);
            points[0] = {others.at[i0], i0};
            points[1] = {others.at[i1], i1};
            left = clip(points, tangent, dot(tangent, start)) && clip(points, -tangent, -dot(tangent, end));
        }

        [[nodiscard]] float separation(Vec2 core) const { return dot(n, core) - offset; }

        [[nodiscard]] int lowest() const
        {
            int lowest = 0;
            for (int i = 1; i < others.count; ++i)
                lowest = dot(n, others.at[i]) < dot(n, others.at[lowest]) ? i : lowest;
            return lowest;
        }

        // Whether the nearest corner of separate outlines is ahead of the edge. Then no corner of the edge is nearer to it.
        [[nodiscard]] bool meets_nearest() const
        {
            const float along = dot(tangent, others.at[lowest()]);
            return along >= dot(tangent, start) && along <= dot(tangent, end);
        }

        void add(const OutlinePoint& p, LocalManifold& out) const
        {
            const float at = separation(p.core);
            const Vec2 on_other = p.core - incident.radius(0) * n;
            const Vec2 on_reference = on_other - at * n;
            out.normal = flipped ? -n : n;
            out.add(flipped ? on_other : on_reference, flipped ? on_reference : on_other, at, feature_id(flipped, edge, p.id));
        }

        void add_points(float margin, LocalManifold& out) const
        {
            out.clipped = {{start + reference.radius(0) * n, end + reference.radius(0) * n},
                           {others.at[i0], others.at[i1]},
                           flipped,
                           incident.radius(0)};
            float left_out = 3e38f;
            for (const OutlinePoint& p : points)
            {
                if (separation(p.core) <= margin)
                {
                    add(p, out);
                    continue;
                }
                left_out = std::min(left_out, separation(p.core));
                if (out.count == 0)
                    std::swap(out.clipped.corners[0], out.clipped.corners[1]);
            }
            float third = 3e38f;
            for (int i = 0; i < others.count; ++i)
            {
                if (i != i0 && i != i1)
                    third = std::min(third, separation(others.at[i]));
            }
            out.bound_by_third(third, left_out);
        }
    };

    static bool are_apart(Vec2 direction, float separation, LocalManifold& out)
    {
        out.part(direction, separation);
        return true;
    }

    // Lengths matter only between near equals.
    [[nodiscard]] bool edge_is_of_b(const EdgeAxis& a, const EdgeAxis& b) const
    {
        const Vec2 da = edge_of(m_a, a.edge);
        const Vec2 db = edge_of(m_b, b.edge);
        const float longest = std::fabs(da.x) + std::fabs(da.y) + std::fabs(db.x) + std::fabs(db.y);
        const float lead = b.separation - a.separation;
        if (std::fabs(lead) > prefers_bias * longest)
            return lead > 0;
        return prefers_b(a.separation, std::sqrt(dot(da, da)), b.separation, std::sqrt(dot(db, db)));
    }

    static Vec2 edge_of(const Hull& v, int edge) { return v.point(v.next(edge)) - v.point(edge); }

    bool clip_to_edge(bool flipped, const EdgeAxis& axis, float margin, LocalManifold& out) const
    {
        const bool apart = axis.separation + m_radii > 1e-6f;
        if (!apart && m_a.count() == 2 && m_b.count() == 2)
            return false; // separations cannot tell whether two lines cross or one continues where the other ends
        const Facing f(*this, flipped, axis.edge);
        if (apart && !f.meets_nearest())
        {
            const float d0 = f.separation(f.points[0].core);
            const float d1 = f.separation(f.points[1].core);
            const float clipped = f.left ? (d0 < d1 ? d0 : d1) : 3e38f;
            if (add_corners(clipped - 1e-4f * length(f.end - f.start), margin, out))
                return true;
        }
        if (f.left)
            f.add_points(margin, out);
        return out.count > 0;
    }

    // Two corners may be nearest where no edge faces one. False where they are not nearer than `than`.
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
        out.add(m_corners_a.at[a] + m_a.radius(0) * n, m_corners_b.at[b] - m_b.radius(0) * n, separation,
                (0x4000u << 16) | (static_cast<std::uint32_t>(a) << 8) | static_cast<std::uint32_t>(b));
        out.nearest = {{m_corners_a.at[a], m_corners_b.at[b]},
                       {m_a.cone(a), rotate(m_pose.rotation, m_b.cone(b))},
                       {m_a.radius(0), m_b.radius(0)}};
        return true;
    }

    const Hull& m_a;
    const Hull& m_b;
    const RelativePose& m_pose;
    float m_radii;
    Corners m_corners_a; ///< in the frame that is currently tested
    Corners m_corners_b; ///< in a's frame
};

} // namespace

void collide_outlines(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out)
{
    if (is_outline(*a.leaf) && is_outline(*b.leaf))
    {
        const Hull hull_a(a);
        const Hull hull_b(b);
        OutlinePair pair(hull_a, hull_b, pose);
        if (pair.collide(margin, out))
        {
            if (b.leaf->type == LeafType::Segment && is_of_chain(*b.leaf))
                pair.keep_to_piece(*b.leaf, margin, out);
            return;
        }
        out = {};
        out.reach = margin;
    }
    collide_hull_hull(a, b, pose, margin, out);
}

} // namespace carom::internal
