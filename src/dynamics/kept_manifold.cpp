#include "dynamics/kept_manifold.h"

#include "collision/edge_rules.h"
#include "dynamics/contact_update.h"
#include "dynamics/scene_data.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

constexpr float least_cosine = 0.98f; // 11 degrees: the edge that faces best is likely to be the same
constexpr float surely_turned = 0.9801f;

// An edge's normal belongs to the body of the edge; what is nearest at two corners, or on two circles, has a normal of its own.
bool can_keep(const SceneState& state, const Contact& contact, const LocalManifold& found)
{
    const auto has_edges = [&](int shape)
    {
        const LeafType type = state.shapes[shape].leaf.type;
        const bool is_line = type == LeafType::Segment && (contact.flags & contact_flag::plain) != 0;
        return type == LeafType::Polygon || type == LeafType::Capsule || type == LeafType::Circle || is_line;
    };
    return (contact.flags & contact_flag::one_way) == 0 && has_edges(contact.shape_a) && has_edges(contact.shape_b) &&
           (found.count == 0 || found.clipped.radius >= 0);
}

const BodySim& sim_of(const SceneState& state, int body) { return state.sims[static_cast<std::size_t>(body)]; }

Vec2 place_of_b(const BodySim& a, const BodySim& b) { return inverse_rotate(a.rotation, b.center - a.center); }

// How far any point of b has moved against a since the manifold was found, and the cosine of the angle that it has turned.
struct Moved
{
    float way = 3e38f;
    float cosine = -1;
};

Moved moved_since(const KeptManifold& kept, const BodySim& a, const BodySim& b)
{
    const Rotation turn = inverse(a.rotation) * b.rotation * inverse(kept.rotation);
    const float chord = std::sqrt(turn.s * turn.s + (1 - turn.c) * (1 - turn.c));
    return {length(place_of_b(a, b) - kept.center) + b.extent * chord, turn.c};
}

void keep(KeptManifold& kept, const BodySim& a, const BodySim& b, const LocalManifold& found)
{
    kept.center = place_of_b(a, b);
    kept.rotation = inverse(a.rotation) * b.rotation;
    kept.reach = found.reach;
    if (found.count == 0)
        return;
    const RelativePose pose = relative_pose(a.pose(), b.pose());
    const bool of_b = found.clipped.of_b;
    const auto on_a = [&](Vec2 p) { return p - a.local_center; };
    const auto on_b = [&](Vec2 p) { return pose.to_b(p) - b.local_center; };
    for (std::size_t i = 0; i < 2; ++i)
    {
        const Vec2 edge = found.clipped.edge[i];
        const Vec2 corner = found.clipped.corners[i];
        kept.edge[i] = of_b ? on_b(edge) : on_a(edge);
        kept.corners[i] = of_b ? on_a(corner) : on_b(corner);
    }
    kept.normal = of_b ? inverse_rotate(pose.rotation, found.normal) : found.normal;
    kept.radius = found.clipped.radius;
}

// What has no point has no edge that another could take the place of.
bool is_true_still(int points, const Moved& moved, float margin, float reach, float longest_way)
{
    const bool keeps_edge = points == 0 ? moved.cosine > 0 : moved.way < longest_way && moved.cosine > least_cosine;
    return keeps_edge && (points == 2 ? moved.way <= reach : margin + moved.way <= reach);
}

// The two corners before the edge, from the center of the edge's body.
struct Facing
{
    const KeptManifold& kept;
    bool of_b;
    Vec2 n;      ///< out of the edge
    Vec2 offset; ///< from the center of the edge's body to the other's
    Vec2 start;  ///< of the edge
    Vec2 corners[2];
    float along[2]; ///< how far along the edge, times its length
    float end;      ///< as far is the edge's

    Facing(const KeptManifold& k, const BodySim& a, const BodySim& b, bool edge_of_b) : kept(k), of_b(edge_of_b)
    {
        const BodySim& own = of_b ? b : a;
        const BodySim& other = of_b ? a : b;
        const Vec2 apart = b.center - a.center;
        const Vec2 normal = rotate(own.rotation, kept.normal);
        n = of_b ? -normal : normal;
        offset = of_b ? -apart : apart;
        start = rotate(own.rotation, kept.edge[0]);
        const Vec2 edge = rotate(own.rotation, kept.edge[1]) - start;
        end = dot(edge, edge);
        for (int i = 0; i < 2; ++i)
        {
            corners[i] = offset + rotate(other.rotation, kept.corners[i]);
            along[i] = dot(edge, corners[i] - start);
        }
    }

    // Does the edge between the corners lie before the edge? A single one must not have left it.
    [[nodiscard]] bool meets(int points) const
    {
        const bool left = along[0] < 0 && (points == 1 || along[1] < 0);
        const bool right = along[0] > end && (points == 1 || along[1] > end);
        return !left && !right;
    }

    // What of the edge between the corners is before the edge ends at its ends.
    void put(int i, ManifoldPoint& p) const
    {
        const float inside = std::min(std::max(along[i], 0.0f), end);
        const float beyond = inside - along[i];
        const float t = beyond != 0 ? beyond / (along[1 - i] - along[i]) : 0;
        const Vec2 core = corners[i] + t * (corners[1 - i] - corners[i]);
        p.separation = dot(n, core - start) - kept.radius;
        const Vec2 on_other = core - kept.radius * n;
        const Vec2 on_edge = on_other - p.separation * n;
        p.anchor_a = of_b ? on_other - offset : on_edge;
        p.anchor_b = of_b ? on_edge : on_other - offset;
    }
};

void follow(const KeptManifold& kept, const BodySim& a, const BodySim& b, bool of_b, Manifold& m)
{
    if (m.count == 0)
        return;
    const Facing facing(kept, a, b, of_b);
    m.normal = rotate(of_b ? b.rotation : a.rotation, kept.normal);
    for (int i = 0; i < m.count; ++i)
        facing.put(i, m.points[i]);
}

bool faces_still(const KeptManifold& kept, const BodySim& a, const BodySim& b, const Contact& contact)
{
    return contact.manifold.count == 0 || Facing(kept, a, b, keeps_edge_of_b(contact)).meets(contact.manifold.count);
}

} // namespace

void follow_manifold(const StepContext& ctx, int index)
{
    SceneState& state = ctx.state;
    Contact& contact = state.contacts[index];
    KeptManifold& kept = state.kept_manifolds[static_cast<std::size_t>(index)];
    const BodySim& a = sim_of(state, contact.body_a);
    const BodySim& b = sim_of(state, contact.body_b);
    const Tolerances& t = ctx.scene.tolerances;
    contact.flags &= ~contact_flag::followed;
    const Moved moved = is_kept(contact) ? moved_since(kept, a, b) : Moved{};
    const float margin = t.speculation + relative_motion(state, contact);
    if (is_true_still(contact.manifold.count, moved, margin, kept.reach, t.keep) && faces_still(kept, a, b, contact))
    {
        follow(kept, a, b, keeps_edge_of_b(contact), contact.manifold);
        return;
    }
    const Manifold old = contact.manifold;
    const BodyPose pose_a = pose_at_start(state, contact.body_a);
    const BodyPose pose_b = pose_at_start(state, contact.body_b);
    const LocalManifold found = local_manifold(state, contact, pose_a, pose_b, margin);
    contact.manifold = in_world(found, pose_a, pose_b);
    carry_impulses(old, contact.manifold);
    contact.flags &= ~(contact_flag::kept | contact_flag::edge_of_b);
    if (!can_keep(state, contact, found))
        return;
    contact.flags |= contact_flag::kept | (found.clipped.of_b ? contact_flag::edge_of_b : 0u);
    keep(kept, a, b, found);
}

FollowedScene followed_scene(const StepContext& ctx)
{
    const Tolerances& t = ctx.scene.tolerances;
    return {ctx.state.sims.data(),
            &ctx.state.contacts[0],
            ctx.state.kept_manifolds.data(),
            surely * t.keep,
            surely,
            surely_turned,
            t.slop,
            t.speculation};
}

Manifold manifold_at_start(const SceneState& state, int index)
{
    const Contact& contact = state.contacts[index];
    Manifold m = contact.manifold;
    if ((contact.flags & contact_flag::followed) != 0)
        follow(state.kept_manifolds[static_cast<std::size_t>(index)], sim_of(state, contact.body_a),
               sim_of(state, contact.body_b), keeps_edge_of_b(contact), m);
    return m;
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
    follow(state.kept_manifolds[static_cast<std::size_t>(index)], before(contact.body_a), before(contact.body_b),
           keeps_edge_of_b(contact), m);
    return m;
}

void settle_manifold(SceneState& state, int index)
{
    state.contacts[index].manifold = settled_manifold(state, index);
    state.contacts[index].flags &= ~contact_flag::followed;
}

} // namespace carom::internal
