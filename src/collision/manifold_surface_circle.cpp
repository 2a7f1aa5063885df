// Anything against a circle: the distance from the circle's center to the surface, less its radius.

#include "collision/manifold.h"
#include "geometry/surface.h"

namespace carom::internal {

void collide_surface_circle(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out)
{
    const float r = b.leaf->r0;
    const Vec2 c = pose.to_a(b.leaf->p0);
    const std::optional<Surface<float>> s = surface_at<float>(a, c.x, c.y);
    if (!s || s->distance - r > margin)
        return;
    const Vec2 n = {s->nx, s->ny};
    out.normal = n;
    out.add(c - s->distance * n, c - r * n, s->distance - r, static_cast<std::uint32_t>(s->feature));
}

} // namespace carom::internal
