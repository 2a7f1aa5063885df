// Manifolds in the world's axes, and which of their points are those of the last step.

#include "dynamics/narrowphase/contact_update.h"

#include "collision/edge_rules.h"
#include "core/index.h"
#include "dynamics/narrowphase/flush_pair.h"
#include "dynamics/state/contact_store.h"

#include <utility>

namespace carom::internal {

LocalManifold local_manifold(const SceneState& state, const Contact& contact, const BodyPose& a, const BodyPose& b, float margin)
{
    const LeafView leaf_a = leaf_view(state, contact.shape_a);
    const LeafView leaf_b = leaf_view(state, contact.shape_b);
    const RelativePose pose = relative_pose(a.frame(), b.frame());
    LocalManifold found = collide(leaf_a, leaf_b, pose, margin);
    if (found.count == 0 || (contact.flags & contact_flag::trigger) != 0)
        return found;
    if (const FlushPair flush(state, contact, pose, found); !flush.is_empty())
        found.is_of_union = keep_to_union(leaf_a, flush.of_a, leaf_b, flush.of_b, pose, margin, found);
    return found;
}

Manifold in_world(const LocalManifold& local, const BodyPose& a, const BodyPose& b)
{
    Manifold m;
    m.count = local.count;
    m.normal = rotate(a.rotation, local.normal);
    const Vec2 center_b = inverse_rotate(a.rotation, b.center - a.frame().position); // in a's frame
    for (int i = 0; i < local.count; ++i)
    {
        const LocalPoint& p = local.points[i];
        m.points[i].anchor_a = rotate(a.rotation, p.on_a - a.local_center);
        m.points[i].anchor_b = rotate(a.rotation, p.on_b - center_b);
        m.points[i].separation = p.separation;
        m.points[i].feature = p.feature;
    }
    return m;
}

Manifold world_manifold(const SceneState& state, const Contact& contact, const BodyPose& a, const BodyPose& b, float margin)
{
    return in_world(local_manifold(state, contact, a, b, margin), a, b);
}

namespace {

constexpr float nearly_parallel = 0.9f; // cosine of the angle between normals

// The nearer of the old points, if the reference edge has changed.
int nearest_point(const Manifold& old, const ManifoldPoint& p)
{
    int nearest = none;
    float least = 3e38f;
    for (int j = 0; j < old.count; ++j)
    {
        const Vec2 d = p.anchor_a - old.points[j].anchor_a;
        const float distance = dot(d, d);
        if (!is_reference_changed(old.points[j].feature, p.feature) || distance >= least)
            continue;
        least = distance;
        nearest = j;
    }
    return nearest;
}

} // namespace

std::array<int, 2> match_points(const Manifold& old, const Manifold& fresh)
{
    std::array<int, 2> from = {none, none};
    for (int i = 0; i < fresh.count; ++i)
    {
        for (int j = 0; j < old.count; ++j)
        {
            if (fresh.points[i].feature == old.points[j].feature || (fresh.count == 1 && old.count == 1))
                from[as_index(i)] = j;
        }
        if (from[as_index(i)] == none && dot(old.normal, fresh.normal) > nearly_parallel)
            from[as_index(i)] = nearest_point(old, fresh.points[i]);
    }
    const bool both = fresh.count == 2 && from[0] == from[1] && from[0] != none;
    if (!both)
        return from;
    // One place has divided, or two are about to meet: the farther one is new.
    const auto distance = [&](int i) { return length(fresh.points[i].anchor_a - old.points[from[0]].anchor_a); };
    from[distance(0) <= distance(1) ? 1 : 0] = none;
    return from;
}

void carry_impulses(const Manifold& old, Manifold& fresh, ContactImpulses& impulses)
{
    fresh.rolling_impulse = old.rolling_impulse;
    const ContactImpulses before = std::exchange(impulses, {});
    const auto carry = [&](int i, int j) { impulses.points[i] = before.points[j]; };
    if (fresh.count == 0) // kept for the next piece of the chain, to which the ball may have rolled
        carry(0, 0);
    const std::array<int, 2> from = match_points(old, fresh);
    for (int i = 0; i < fresh.count; ++i)
    {
        if (from[as_index(i)] != none)
            carry(i, from[as_index(i)]);
    }
}

} // namespace carom::internal
