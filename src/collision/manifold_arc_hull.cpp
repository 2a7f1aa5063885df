// An arc against a hull. On the hollow side the two deepest corners of the hull touch. On the round side and at the ends the arc is a circle that
// touches the hull's surface.

#include "collision/hull.h"
#include "collision/manifold.h"

namespace carom::internal {

namespace {

bool faces(const LeafView& arc, bool inside)
{
    const Sides sides = arc.leaf->sides;
    return sides == Sides::Both || sides == side_of(arc, inside);
}

struct Corner
{
    int index = -1;
    float separation = 3e38f;
};

constexpr float uneven = 0.02f; // relative to the chord of the corners

// One normal for both corners. It is perpendicular to their chord while they are equally deep, and becomes the deeper corner's as one gets deeper. In a hollow
// that is hardly wider than the hull the other corner is then left out.
Vec2 hollow_normal(const Leaf& arc, const Hull& hull, Corner (&corners)[2])
{
    const Vec2 first = hull.point(corners[0].index) - arc.p0;
    if (corners[1].index < 0)
        return -normalize(first);
    const Vec2 second = hull.point(corners[1].index) - arc.p0;
    const float deeper = (corners[1].separation - corners[0].separation) / (uneven * length(second - first));
    if (deeper < 1)
        return -normalize(first + (1 - deeper) * second);
    if (dot(first, second) < one_normal * length(first) * length(second))
        corners[1].index = -1;
    return -normalize(first);
}

// Finds the hull's corners inside the circle of the arc that are nearest to it.
void collide_hollow_side(const LeafView& v, const Hull& hull, float margin, LocalManifold& out)
{
    const Leaf& arc = *v.leaf;
    Corner corners[2];
    for (int i = 0; i < hull.count(); ++i)
    {
        const Vec2 r = hull.point(i) - arc.p0;
        const float separation = arc.arc_radius - arc.r0 - hull.radius(i) - length(r);
        if (!is_in_sweep(v, r) || separation > margin)
            continue;
        if (separation < corners[0].separation)
        {
            corners[1] = corners[0];
            corners[0] = {i, separation};
        }
        else if (separation < corners[1].separation)
        {
            corners[1] = {i, separation};
        }
    }
    if (corners[0].index < 0)
        return;
    const Vec2 n = hollow_normal(arc, hull, corners);
    out.normal = n;
    for (const Corner& c : corners)
    {
        if (c.index < 0)
            continue;
        const Vec2 on_b = hull.point(c.index) - hull.radius(c.index) * n;
        out.add(on_b - c.separation * n, on_b, c.separation, static_cast<std::uint32_t>(c.index));
    }
}

// A circle of the arc (its whole outside, or the round cap of an end) against the hull's surface.
struct Round
{
    Vec2 center;
    float radius;
    std::uint32_t feature;
};

void collide_round(const LeafView& hull, const RelativePose& pose, const Round& circle, float margin, LocalManifold& out)
{
    const Vec2 c = pose.to_b(circle.center);
    const std::optional<Surface<float>> s = surface_at<float>(hull, c.x, c.y);
    if (!s || s->distance - circle.radius > margin)
        return;
    const Vec2 n = -rotate(pose.rotation, {s->nx, s->ny});
    out.normal = n;
    out.add(circle.center + circle.radius * n, circle.center + s->distance * n, s->distance - circle.radius, circle.feature);
}

} // namespace

void collide_arc_hull(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out)
{
    const Leaf& arc = *a.leaf;
    const HullSeen hull(b, pose);
    const bool inside = length(hull.center() - arc.p0) < arc.arc_radius;
    if (!faces(a, inside))
        return;
    if (inside)
    {
        collide_hollow_side(a, hull, margin, out);
    }
    else
    {
        collide_round(b, pose, {arc.p0, arc.arc_radius + arc.r0, 0x100}, margin, out);
        if (out.count > 0 && !is_in_sweep(a, out.points[0].on_a - arc.p0))
            out.count = 0;
    }
    if (out.count == 0 && !arc.has_previous)
        collide_round(b, pose, {a.span->start, arc.r0, 0x101}, margin, out);
    if (out.count == 0 && !arc.has_next)
        collide_round(b, pose, {a.span->end, arc.r0, 0x102}, margin, out);
}

} // namespace carom::internal
