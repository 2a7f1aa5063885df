#include "geometry/bounds.h"

#include <algorithm>
#include <limits>

namespace carom::internal {

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

// Collects the extremes of points in coordinates relative to the pose's position.
struct Extremes
{
    float lx = infinity;
    float ly = infinity;
    float ux = -infinity;
    float uy = -infinity;

    void add(Vec2 p, float r)
    {
        lx = std::min(lx, p.x - r);
        ly = std::min(ly, p.y - r);
        ux = std::max(ux, p.x + r);
        uy = std::max(uy, p.y + r);
    }
    [[nodiscard]] Box at(Position p) const { return {{p.x + lx, p.y + ly}, {p.x + ux, p.y + uy}}; }
};

// The four compass points of the circle that lie on the arc, and its ends.
void add_arc(Extremes& e, const Leaf& leaf, Rotation q)
{
    const Vec2 c = rotate(q, leaf.p0);
    const Vec2 mid = rotate(q, leaf.p1);
    e.add(rotate(q, leaf.arc_start), leaf.r0);
    e.add(rotate(q, leaf.arc_end), leaf.r0);
    const Vec2 compass[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (Vec2 d : compass)
    {
        if (dot(d, mid) >= leaf.cos_half_sweep)
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
    case LeafType::Polygon:
        for (int i = 0; i < leaf.count; ++i)
            e.add(rotate(q, v.points[i]), leaf.r0);
        break;
    case LeafType::Capsule:
    case LeafType::Segment:
        e.add(rotate(q, leaf.p0), leaf.r0);
        e.add(rotate(q, leaf.p1), leaf.r1);
        break;
    case LeafType::Arc: add_arc(e, leaf, q); break;
    }
    return e.at(pose.position);
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
