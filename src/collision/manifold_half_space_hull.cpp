// A half-space against a hull: the contact points are the hull's one or two deepest corners.

#include "collision/hull.h"
#include "collision/manifold.h"

namespace carom::internal {

void collide_half_space_hull(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out)
{
    const Vec2 n = a.leaf->p0;
    const HullSeen hull(b, pose);
    const auto depth = [&](int i) { return dot(n, hull.point(i)) - hull.radius(i) - a.leaf->r0; };
    int deepest = 0;
    for (int i = 1; i < hull.count(); ++i)
    {
        if (depth(i) < depth(deepest))
            deepest = i;
    }
    const int before = (deepest + hull.count() - 1) % hull.count();
    const int after = hull.next(deepest);
    const int second = depth(after) <= depth(before) ? after : before;
    out.normal = n;
    for (int i : {deepest, second})
    {
        if (depth(i) <= margin && (i == deepest || out.count == 1))
        {
            const Vec2 on_b = hull.point(i) - hull.radius(i) * n;
            out.add(on_b - depth(i) * n, on_b, depth(i), static_cast<std::uint32_t>(i));
        }
    }
}

} // namespace carom::internal
