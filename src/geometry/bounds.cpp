// Boxes and extents of leaves.

#include "geometry/bounds.h"

#include <algorithm>
#include <limits>

namespace carom::internal {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Collects the extremes of points relative to the pose's position, two points at once: x and y of one, then of the other.
class Extremes
{
public:
    void add(F4 points, F4 r)
    {
        m_low = least(m_low, points - r);
        m_high = greatest(m_high, points + r);
    }
    void add(Vec2 p, float r) { add(four_of(p.x, p.y, p.x, p.y), r); }
    [[nodiscard]] Box at(Position p) const
    {
        const FloatBox b = box_of(low_and_high(least(m_low, swapped_halves(m_low)), greatest(m_high, swapped_halves(m_high))));
        return {{p.x + b.lx, p.y + b.ly}, {p.x + b.ux, p.y + b.uy}};
    }

private:
    F4 m_low = infinity;
    F4 m_high = -m_low;
};

F4 rotate_both(Rotation q, F4 points) { return q.c * points + four_of(-q.s, q.s, -q.s, q.s) * swapped_neighbours(points); }

// A polygon has at least three corners; an odd last one is added together with the one before it, which is then added twice.
void add_polygon(Extremes& e, const LeafView& v, Rotation q)
{
    for (int i = 0; i < v.leaf->count; i += 2)
        e.add(rotate_both(q, load4(&v.points[std::min(i, v.leaf->count - 2)].x)), v.leaf->r0);
}

// Adds the compass points of the circle that lie on the arc, and the ends of the arc.
void add_arc(Extremes& e, const LeafView& v, Rotation q)
{
    const Leaf& leaf = *v.leaf;
    const Vec2 c = rotate(q, leaf.p0);
    const Vec2 mid = rotate(q, leaf.p1);
    e.add(rotate(q, v.span->start), leaf.r0);
    e.add(rotate(q, v.span->end), leaf.r0);
    const Vec2 compass[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (Vec2 d : compass)
    {
        if (dot(d, mid) >= v.span->cos_half_sweep)
            e.add(c + leaf.arc_radius * d, leaf.r0);
    }
}

} // namespace

Box leaf_bounds(const LeafView& v, const Pose& pose)
{
    const Leaf& leaf = *v.leaf;
    const Rotation q = pose.rotation;
    Extremes e;
    switch (leaf.type)
    {
    case LeafType::HalfSpace: return {{-1e30, -1e30}, {1e30, 1e30}};
    case LeafType::Circle: e.add(rotate(q, leaf.p0), leaf.r0); break;
    case LeafType::Polygon: add_polygon(e, v, q); break;
    case LeafType::Capsule:
    case LeafType::Segment:
        e.add(rotate_both(q, four_of(leaf.p0.x, leaf.p0.y, leaf.p1.x, leaf.p1.y)), four_of(leaf.r0, leaf.r0, leaf.r1, leaf.r1));
        break;
    case LeafType::Arc: add_arc(e, v, q); break;
    }
    return e.at(pose.position);
}

F4 outer_bounds(const LeafView& view, const Pose& pose)
{
    const Box b = leaf_bounds(view, pose);
    return rounded_outwards(b.lower.x, b.lower.y, b.upper.x, b.upper.y);
}

float leaf_extent(const LeafView& v, Vec2 from)
{
    const Leaf& leaf = *v.leaf;
    switch (leaf.type)
    {
    case LeafType::HalfSpace: return 0;
    case LeafType::Circle: return length(leaf.p0 - from) + leaf.r0;
    case LeafType::Polygon:
    {
        float extent = 0;
        for (int i = 0; i < leaf.count; ++i)
            extent = std::max(extent, length(v.points[i] - from));
        return extent + leaf.r0;
    }
    case LeafType::Capsule:
    case LeafType::Segment: return std::max(length(leaf.p0 - from) + leaf.r0, length(leaf.p1 - from) + leaf.r1);
    case LeafType::Arc: return length(leaf.p0 - from) + leaf.arc_radius + leaf.r0;
    }
    return 0;
}

} // namespace carom::internal
