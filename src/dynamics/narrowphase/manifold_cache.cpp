// Follows cached manifolds from the poses of their bodies, and finds them again where they may have changed.

#include "dynamics/narrowphase/manifold_cache.h"

#include "collision/edge_rules.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/state/scene_data.h"
#include "geometry/leaf_traits.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

constexpr float least_cosine = 0.98f; // 11 degrees: the edge that faces best is probably the same
constexpr float surely_turned = 0.9801f;

// The normal of an edge is fixed to the body of the edge; the normal of two corners or circles is fixed to neither body.
bool can_cache(const SceneState& state, const Contact& contact, const LocalManifold& found)
{
    const auto can_follow_corners = [&](int shape)
    {
        const LeafTraits& traits = traits_of(state.shapes[shape].leaf);
        return traits.has_corners && (!traits.is_line || (contact.flags & contact_flag::plain) != 0);
    };
    return (contact.flags & contact_flag::one_way) == 0 && !found.is_of_union && can_follow_corners(contact.shape_a) &&
           can_follow_corners(contact.shape_b) && (found.count == 0 || found.clipped.radius >= 0 || found.nearest.radii[0] >= 0);
}

const BodySim& sim_of(const SceneState& state, int body) { return state.sims[static_cast<std::size_t>(body)]; }

Vec2 place_of(const BodySim& other, const BodySim& own) { return inverse_rotate(own.rotation, other.center - own.center); }

// Bound on the displacement of any point of the other body relative to the edge's body since the manifold was found, and the cosine of the angle by which it
// has turned.
struct Moved
{
    float displacement;
    float cosine;
};

Rotation turned_since(const CachedManifold& cached, const BodySim& own, const BodySim& other)
{
    return inverse(own.rotation) * other.rotation * inverse(cached.rotation);
}

// Chord of a rotation, on a circle of radius 1.
float chord_of(Rotation turn) { return std::sqrt(turn.s * turn.s + (1 - turn.c) * (1 - turn.c)); }

Moved moved_since(const CachedManifold& cached, const BodySim& own, const BodySim& other)
{
    const Rotation turn = turned_since(cached, own, other);
    return {length(place_of(other, own) - cached.center) + other.extent * chord_of(turn), turn.c};
}

// Lower bound on the distance of two shapes without a point. Only displacement along the separating direction, and rotation, reduce it.
float room(const CachedManifold& cached, const BodySim& own, const BodySim& other)
{
    const Vec2 displacement = place_of(other, own) - cached.center;
    const Vec2 direction = cached.found.parting.direction;
    const float gain = direction == Vec2{} ? -length(displacement) : dot(direction, displacement);
    return cached.reach + gain - cached.found.parting.arm * chord_of(turned_since(cached, own, other));
}

// Bound on the distance of the shape's corners from the center of rotation.
float arm_of(const SceneState& state, int shape, const BodySim& sim)
{
    const Leaf& leaf = state.shapes[shape].leaf;
    return sim.extent - (traits_of(leaf).has_two_ends ? std::min(leaf.r0, leaf.r1) : leaf.r0);
}

void cache_edge(CachedEdge& cached, const BodySim& a, const BodySim& b, const RelativePose& pose, const LocalManifold& found)
{
    const bool of_b = found.clipped.of_b;
    const auto on_a = [&](Vec2 p) { return p - a.local_center; };
    const auto on_b = [&](Vec2 p) { return pose.to_b(p) - b.local_center; };
    for (std::size_t i = 0; i < 2; ++i)
    {
        const Vec2 edge = found.clipped.edge[i];
        const Vec2 corner = found.clipped.corners[i];
        cached.edge[i] = of_b ? on_b(edge) : on_a(edge);
        cached.corners[i] = of_b ? on_a(corner) : on_b(corner);
    }
    cached.normal = of_b ? inverse_rotate(pose.rotation, found.normal) : found.normal;
}

void cache_corners(CachedCorners& cached, const BodySim& a, const BodySim& b, const RelativePose& pose,
                   const NearestCorners& found)
{
    cached.corners[0] = found.at[0] - a.local_center;
    cached.corners[1] = pose.to_b(found.at[1]) - b.local_center;
    cached.cones[0] = found.cones[0];
    cached.cones[1] = inverse_rotate(pose.rotation, found.cones[1]);
    cached.radii[0] = found.radii[0];
    cached.radii[1] = found.radii[1];
}

// True if the cached data is in the axes of b.
bool is_of_b(const SceneState& state, const Contact& contact, const LocalManifold& found)
{
    if (found.count > 0)
        return found.clipped.radius >= 0 && found.clipped.of_b;
    return arm_of(state, contact.shape_a, sim_of(state, contact.body_a)) <
           arm_of(state, contact.shape_b, sim_of(state, contact.body_b));
}

void keep(const SceneState& state, const Contact& contact, const LocalManifold& found, CachedManifold& cached)
{
    const BodySim& a = sim_of(state, contact.body_a);
    const BodySim& b = sim_of(state, contact.body_b);
    const bool of_b = caches_edge_of_b(contact);
    const BodySim& own = of_b ? b : a;
    const BodySim& other = of_b ? a : b;
    cached.center = place_of(other, own);
    cached.rotation = inverse(own.rotation) * other.rotation;
    cached.reach = found.reach;
    cached.radius = found.clipped.radius;
    const RelativePose pose = relative_pose(a.pose(), b.pose());
    if (found.count == 0)
        cached.found.parting = {of_b ? inverse_rotate(pose.rotation, -found.parting) : found.parting,
                                arm_of(state, of_b ? contact.shape_a : contact.shape_b, other)};
    else if (found.clipped.radius >= 0)
        cache_edge(cached.found.edge, a, b, pose, found);
    else
        cache_corners(cached.found.nearest, a, b, pose, found.nearest);
}

// Distance within which the shapes get points.
float margin_of(const StepContext& ctx, const Contact& contact)
{
    return ctx.scene.tolerances.speculation + relative_motion(ctx.state, contact);
}

// The two corners before the edge, relative to the center of the edge's body.
struct Facing
{
    float radius;
    bool of_b;
    Vec2 n;      ///< outward normal of the edge
    Vec2 offset; ///< from the center of the edge's body to the center of the other
    Vec2 start;  ///< start of the edge
    Vec2 corners[2];
    float along[2]; ///< positions of the corners along the edge, times its length
    float end;      ///< the same for the end of the edge

    Facing(const CachedManifold& k, const BodySim& a, const BodySim& b, bool edge_of_b) : radius(k.radius), of_b(edge_of_b)
    {
        const CachedEdge& cached = k.found.edge;
        const BodySim& own = of_b ? b : a;
        const BodySim& other = of_b ? a : b;
        const Vec2 apart = b.center - a.center;
        const Vec2 normal = rotate(own.rotation, cached.normal);
        n = of_b ? -normal : normal;
        offset = of_b ? -apart : apart;
        start = rotate(own.rotation, cached.edge[0]);
        const Vec2 edge = rotate(own.rotation, cached.edge[1]) - start;
        end = dot(edge, edge);
        for (int i = 0; i < 2; ++i)
        {
            corners[i] = offset + rotate(other.rotation, cached.corners[i]);
            along[i] = dot(edge, corners[i] - start);
        }
    }

    // An end of the segment between the corners, clipped to the part before the edge.
    struct Foot
    {
        Vec2 on_edge;
        Vec2 on_other;
        float separation;
        bool inside; ///< not clipped: the corner itself
    };

    [[nodiscard]] Foot foot(int i) const
    {
        const float nearest = std::min(std::max(along[i], 0.0f), end);
        const float beyond = nearest - along[i];
        const float t = beyond != 0 ? beyond / (along[1 - i] - along[i]) : 0;
        const Vec2 core = corners[i] + t * (corners[1 - i] - corners[i]);
        Foot f;
        f.separation = dot(n, core - start) - radius;
        f.on_other = core - radius * n;
        f.on_edge = f.on_other - f.separation * n;
        f.inside = beyond == 0;
        return f;
    }

    // Does any of the segment between the corners lie before the edge?
    [[nodiscard]] bool meets() const { return !(along[0] < 0 && along[1] < 0) && !(along[0] > end && along[1] > end); }

    // Clipping a steep segment at the end of the edge may cut off its lowest corner, which is still the nearest point just beside that end.
    [[nodiscard]] bool is_steep() const
    {
        const float rise = dot(n, corners[1] - corners[0]);
        const float run = along[1] - along[0];
        return rise * rise * end > run * run;
    }

    [[nodiscard]] bool is_round() const { return corners[0].x == corners[1].x && corners[0].y == corners[1].y; }

    void put(int i, ManifoldPoint& p) const
    {
        const Foot f = foot(i);
        p.separation = f.separation;
        p.anchor_a = of_b ? f.on_other - offset : f.on_edge;
        p.anchor_b = of_b ? f.on_edge : f.on_other - offset;
    }
};

// Is the edge still the one that faces best? Certainly where the lowest corner is outside and before it; otherwise for small motion only.
bool is_best_still(const Facing& facing, const Facing::Foot& lowest, const Moved& moved, float longest_path)
{
    const bool is_outside = lowest.inside && lowest.separation + facing.radius > 0;
    return is_outside || (moved.displacement < longest_path && moved.cosine > least_cosine);
}

// One corner is before the edge, and the other is too far away to be a second point.
bool has_one_point(const CachedManifold& cached, const Facing& facing, const Moved& moved, float margin, float longest_path)
{
    const Facing::Foot near = facing.foot(0);
    const bool is_alone = facing.is_round() || facing.foot(1).separation > margin;
    return near.inside && near.separation <= margin && is_alone && margin + moved.displacement <= cached.reach &&
           is_best_still(facing, near, moved, longest_path);
}

// Both corners are before the edge, and no other corner has replaced one of them.
bool has_two_points(const CachedManifold& cached, const Facing& facing, const Moved& moved, float longest_path)
{
    const Facing::Foot first = facing.foot(0);
    const Facing::Foot second = facing.foot(1);
    const Facing::Foot& lowest = second.separation < first.separation ? second : first;
    return facing.meets() && (lowest.inside || !facing.is_steep()) && lowest.separation <= longest_path &&
           moved.displacement <= cached.reach && is_best_still(facing, lowest, moved, longest_path);
}

// The line between the two nearest corners.
struct Nearest
{
    const CachedCorners& cached;
    Vec2 from; ///< corner from the center of a; `to`: from the center of b
    Vec2 to;
    Vec2 n;
    float separation;
    bool leads_out; ///< the line leads out of both cones: nothing is nearer

    Nearest(const CachedCorners& k, const BodySim& a, const BodySim& b) : cached(k)
    {
        from = rotate(a.rotation, cached.corners[0]);
        to = rotate(b.rotation, cached.corners[1]);
        const Vec2 gap = (b.center - a.center) + to - from;
        const float distance = std::sqrt(dot(gap, gap));
        n = {gap.x / distance, gap.y / distance};
        separation = distance - (cached.radii[0] + cached.radii[1]);
        leads_out = distance > CachedCorners::least_distance &&
                    dot(n, rotate(a.rotation, cached.cones[0])) >= dot(cached.cones[0], cached.cones[0]) &&
                    dot(-n, rotate(b.rotation, cached.cones[1])) >= dot(cached.cones[1], cached.cones[1]);
    }

    void put(Manifold& m) const
    {
        m.normal = n;
        m.points[0].separation = separation;
        m.points[0].anchor_a = from + cached.radii[0] * n;
        m.points[0].anchor_b = to - cached.radii[1] * n;
    }
};

void follow(const CachedManifold& cached, const BodySim& a, const BodySim& b, const Contact& contact, Manifold& m)
{
    if (m.count == 0)
        return;
    if (caches_nearest(contact))
    {
        Nearest(cached.found.nearest, a, b).put(m);
        return;
    }
    const bool of_b = caches_edge_of_b(contact);
    const Facing facing(cached, a, b, of_b);
    m.normal = rotate(of_b ? b.rotation : a.rotation, cached.found.edge.normal);
    for (int i = 0; i < m.count; ++i)
        facing.put(i, m.points[i]);
}

// Would the narrow phase still find the cached features?
bool can_follow(const CachedManifold& cached, const BodySim& a, const BodySim& b, const Contact& contact, float margin,
                float longest_path)
{
    if (!is_cached(contact))
        return false;
    if (contact.manifold.count == 0)
        return margin <= (caches_edge_of_b(contact) ? room(cached, b, a) : room(cached, a, b));
    if (caches_nearest(contact))
    {
        const Nearest nearest(cached.found.nearest, a, b);
        return nearest.leads_out && nearest.separation <= margin;
    }
    const bool of_b = caches_edge_of_b(contact);
    const Moved moved = of_b ? moved_since(cached, b, a) : moved_since(cached, a, b);
    const Facing facing(cached, a, b, of_b);
    return contact.manifold.count == 1 ? has_one_point(cached, facing, moved, margin, longest_path)
                                       : has_two_points(cached, facing, moved, longest_path);
}

} // namespace

void follow_manifold(const StepContext& ctx, int index)
{
    SceneState& state = ctx.state;
    Contact& contact = state.contacts[index];
    CachedManifold& cached = state.cached_manifolds[static_cast<std::size_t>(index)];
    const BodySim& a = sim_of(state, contact.body_a);
    const BodySim& b = sim_of(state, contact.body_b);
    const Tolerances& t = ctx.scene.tolerances;
    contact.flags &= ~contact_flag::followed;
    const float margin = margin_of(ctx, contact);
    if (can_follow(cached, a, b, contact, margin, t.keep))
    {
        follow(cached, a, b, contact, contact.manifold);
        return;
    }
    const Manifold old = contact.manifold;
    const BodyPose pose_a = pose_at_start(state, contact.body_a);
    const BodyPose pose_b = pose_at_start(state, contact.body_b);
    const LocalManifold found = local_manifold(state, contact, pose_a, pose_b, margin);
    contact.manifold = in_world(found, pose_a, pose_b);
    carry_impulses(old, contact.manifold, impulses_of(state, index));
    contact.flags &= ~(contact_flag::all_cached | contact_flag::of_union);
    contact.flags |= found.is_of_union ? contact_flag::of_union : 0u;
    if (!can_cache(state, contact, found))
        return;
    contact.flags |= contact_flag::cached | (is_of_b(state, contact, found) ? contact_flag::edge_of_b : 0u) |
                     (found.count > 0 && found.clipped.radius < 0 ? contact_flag::nearest : 0u);
    keep(state, contact, found, cached);
}

FollowedScene followed_scene(const StepContext& ctx)
{
    const Tolerances& t = ctx.scene.tolerances;
    return {ctx.state.sims.data(),
            &ctx.state.contacts[0],
            ctx.state.cached_manifolds.data(),
            ctx.state.broad_phase.places(),
            surely * t.keep,
            surely,
            surely_turned,
            t.slop,
            t.speculation};
}

Manifold settled_manifold(const SceneState& state, int index)
{
    const Contact& contact = state.contacts[index];
    Manifold m = contact.manifold;
    if ((contact.flags & contact_flag::followed) == 0)
        return m;
    const auto before = [&](int body)
    {
        BodySim sim = sim_of(state, body);
        if (state.bodies[body].type != BodyType::Static)
        {
            sim.center = sim.previous_center;
            sim.rotation = sim.previous_rotation;
        }
        return sim;
    };
    follow(state.cached_manifolds[static_cast<std::size_t>(index)], before(contact.body_a), before(contact.body_b), contact, m);
    return m;
}

void settle_manifold(SceneState& state, int index)
{
    state.contacts[index].manifold = settled_manifold(state, index);
    state.contacts[index].flags &= ~contact_flag::followed;
}

} // namespace carom::internal
