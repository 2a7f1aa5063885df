// Any leaf against a circle: the distance from the circle's center to the surface, less its radius.

#include "collision/manifold.h"
#include "geometry/surface.h"

namespace carom::internal {

namespace {

// The edge of a feature, its ends on the surface; false where the feature is not an edge, or the leaf has none.
bool find_edge(const LeafView& v, int feature, Vec2 n, Vec2 edge[2])
{
    const Leaf& leaf = *v.leaf;
    if (leaf.type == LeafType::Polygon && feature < leaf.count)
    {
        edge[0] = v.points[feature] + leaf.r0 * n;
        edge[1] = v.points[feature + 1 < leaf.count ? feature + 1 : 0] + leaf.r0 * n;
        return true;
    }
    const bool is_side = (leaf.type == LeafType::Capsule && feature < 2) || (leaf.type == LeafType::Segment && feature == 0);
    if (is_side)
    {
        edge[0] = leaf.p0 + leaf.r0 * n;
        edge[1] = leaf.p1 + leaf.r1 * n;
    }
    return is_side;
}

// The corner of a feature, or the center of a circle; empty for other leaves.
NearestCorners find_corner(const LeafView& v, int feature, Vec2 center, float radius)
{
    const Leaf& leaf = *v.leaf;
    const auto at = [&](Vec2 corner, Vec2 cone, float r) -> NearestCorners
    { return {{corner, center}, {cone, {}}, {r, radius}}; };
    const auto end = [&](int i)
    {
        return i == 0 ? at(leaf.p0, end_cone(leaf.p1, leaf.p0, leaf.r1, leaf.r0), leaf.r0)
                      : at(leaf.p1, end_cone(leaf.p0, leaf.p1, leaf.r0, leaf.r1), leaf.r1);
    };
    switch (leaf.type)
    {
    case LeafType::Circle: return at(leaf.p0, {}, leaf.r0);
    case LeafType::Polygon:
    {
        const int corner = feature - leaf.count;
        return at(v.points[corner], corner_cone(v.normals, leaf.count, corner), leaf.r0);
    }
    case LeafType::Capsule: return end(feature - 2);
    case LeafType::Segment: return end(feature - 1);
    default: return {};
    }
}

} // namespace

void collide_surface_circle(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out)
{
    const float r = b.leaf->r0;
    const Vec2 c = pose.to_a(b.leaf->p0);
    const std::optional<Surface<float>> s = surface_at<float>(a, c.x, c.y);
    if (!s)
        return;
    const Vec2 n = {s->nx, s->ny};
    if (s->distance - r > margin)
    {
        out.part(n, s->distance - r);
        return;
    }
    out.normal = n;
    out.reach = 3e38f; // there is no other point
    out.add(c - s->distance * n, c - r * n, s->distance - r, static_cast<std::uint32_t>(s->feature));
    if (find_edge(a, s->feature, n, out.clipped.edge))
    {
        out.clipped.corners[0] = out.clipped.corners[1] = c;
        out.clipped.radius = r;
    }
    else
    {
        out.nearest = find_corner(a, s->feature, c, r);
    }
}

} // namespace carom::internal
