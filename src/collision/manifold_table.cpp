// The table of collide functions by the types of two leaves.

#include "collision/manifold.h"

#include <cstddef>

namespace carom::internal {

namespace {

// The mirrored entry: swaps the leaves, collides, and returns the result in the frame of the first.
template <CollideFunction collide_swapped>
void mirrored(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin, LocalManifold& out)
{
    const RelativePose swapped{pose.to_b({}), inverse(pose.rotation)};
    LocalManifold m;
    m.reach = margin;
    collide_swapped(b, a, swapped, margin, m);
    out.part(-rotate(pose.rotation, m.parting), m.reach);
    out.normal = -rotate(pose.rotation, m.normal);
    for (int i = 0; i < m.count; ++i)
        out.add(pose.to_a(m.points[i].on_b), pose.to_a(m.points[i].on_a), m.points[i].separation, m.points[i].feature);
    for (std::size_t i = 0; i < 2; ++i)
    {
        out.clipped.edge[i] = pose.to_a(m.clipped.edge[i]);
        out.clipped.corners[i] = pose.to_a(m.clipped.corners[i]);
        out.nearest.at[i] = pose.to_a(m.nearest.at[1 - i]);
        out.nearest.cones[i] = rotate(pose.rotation, m.nearest.cones[1 - i]);
        out.nearest.radii[i] = m.nearest.radii[1 - i];
    }
    out.clipped.of_b = !m.clipped.of_b;
    out.clipped.radius = m.clipped.radius;
}

// Row: type of a, column: type of b, both in the order of LeafType: half-space, circle, polygon, capsule, segment, arc.
constexpr CollideFunction table[leaf_type_count * leaf_type_count] = {
    nullptr,
    collide_surface_circle,
    collide_half_space_hull,
    collide_half_space_hull,
    collide_half_space_hull,
    nullptr,

    mirrored<collide_surface_circle>,
    collide_surface_circle,
    mirrored<collide_surface_circle>,
    mirrored<collide_surface_circle>,
    mirrored<collide_surface_circle>,
    mirrored<collide_surface_circle>,

    mirrored<collide_half_space_hull>,
    collide_surface_circle,
    collide_outlines,
    collide_outlines,
    collide_outlines,
    mirrored<collide_arc_hull>,

    mirrored<collide_half_space_hull>,
    collide_surface_circle,
    mirrored<collide_outlines>,
    collide_outlines,
    collide_outlines,
    mirrored<collide_arc_hull>,

    mirrored<collide_half_space_hull>,
    collide_surface_circle,
    mirrored<collide_outlines>,
    mirrored<collide_outlines>,
    collide_outlines,
    mirrored<collide_arc_hull>,

    nullptr,
    collide_surface_circle,
    collide_arc_hull,
    collide_arc_hull,
    collide_arc_hull,
    nullptr,
};

} // namespace

CollideFunction collide_function(LeafType a, LeafType b)
{
    return table[static_cast<int>(a) * leaf_type_count + static_cast<int>(b)];
}

LocalManifold collide(const LeafView& a, const LeafView& b, const RelativePose& pose, float margin)
{
    LocalManifold out;
    out.reach = margin;
    if (const CollideFunction function = collide_function(a.leaf->type, b.leaf->type))
        function(a, b, pose, margin, out);
    return out;
}

} // namespace carom::internal
