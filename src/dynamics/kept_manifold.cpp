#include "dynamics/kept_manifold.h"

#include "collision/edge_rules.h"
#include "core/float4.h"
#include "dynamics/contact_update.h"
#include "dynamics/scene_data.h"

#include <cmath>

namespace carom::internal {

namespace {

// An edge's normal belongs to the body of the edge; what is nearest at two corners, or round, has a normal of its own.
bool can_keep(const SceneState& state, const Contact& contact)
{
    const auto has_edges = [&](int shape)
    {
        const LeafType type = state.shapes[shape].leaf.type;
        const bool is_line = type == LeafType::Segment && (contact.flags & contact_flag::plain) != 0;
        return type == LeafType::Polygon || type == LeafType::Capsule || is_line;
    };
    const Manifold& m = contact.manifold;
    return (contact.flags & contact_flag::one_way) == 0 && has_edges(contact.shape_a) && has_edges(contact.shape_b) &&
           (m.count == 0 || is_of_edge(m.points[0].feature));
}

const BodySim& sim_of(const SceneState& state, int body) { return state.sims[static_cast<std::size_t>(body)]; }

Vec2 place_of_b(const BodySim& a, const BodySim& b) { return inverse_rotate(a.rotation, b.center - a.center); }

// How far any point of b has moved against a since the manifold was found.
float way_since(const KeptManifold& kept, const BodySim& a, const BodySim& b)
{
    const Rotation turn = inverse(a.rotation) * b.rotation * inverse(kept.rotation);
    return turn.c > 0 ? length(place_of_b(a, b) - kept.center) + b.extent * std::fabs(turn.s) : 3e38f;
}

void keep(KeptManifold& kept, const BodySim& a, const BodySim& b, const Manifold& m, float margin)
{
    kept.center = place_of_b(a, b);
    kept.rotation = inverse(a.rotation) * b.rotation;
    kept.margin = margin;
    for (int i = 0; i < m.count; ++i)
    {
        kept.points[i] = {inverse_rotate(a.rotation, m.points[i].anchor_a), inverse_rotate(b.rotation, m.points[i].anchor_b)};
    }
    if (m.count > 0)
        kept.normal = inverse_rotate(edge_is_of_b(m.points[0].feature) ? b.rotation : a.rotation, m.normal);
}

// Of a point, both anchors at once: {a.x, a.y, b.x, b.y}.
class AnchorTurn
{
public:
    AnchorTurn(Rotation a, Rotation b) : m_cosines{a.c, a.c, b.c, b.c}, m_sines{-a.s, a.s, -b.s, b.s} {}

    [[nodiscard]] F4 operator()(const KeptManifold::Anchors& p) const
    {
        const F4 local = load4(&p.on_a.x);
        return m_cosines * local + m_sines * __builtin_shufflevector(local, local, 1, 0, 3, 2);
    }

private:
    F4 m_cosines;
    F4 m_sines;
};

// The point of the other body stays where it is on it; opposite, on the edge, it slides along.
void follow(const KeptManifold& kept, const BodySim& a, const BodySim& b, Manifold& m)
{
    if (m.count == 0)
        return;
    const bool of_b = edge_is_of_b(m.points[0].feature);
    const Vec2 apart = b.center - a.center;
    const AnchorTurn turned(a.rotation, b.rotation);
    m.normal = rotate(of_b ? b.rotation : a.rotation, kept.normal);
    for (int i = 0; i < m.count; ++i)
    {
        ManifoldPoint& p = m.points[i];
        const F4 anchors = turned(kept.points[i]);
        p.anchor_a = {anchors[0], anchors[1]};
        p.anchor_b = {anchors[2], anchors[3]};
        const Vec2 gap = apart + (p.anchor_b - p.anchor_a);
        p.separation = dot(m.normal, gap);
        const Vec2 slid = gap - p.separation * m.normal;
        if (of_b)
            p.anchor_b -= slid;
        else
            p.anchor_a += slid;
    }
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
    const float way = is_kept(contact) ? way_since(kept, a, b) : 3e38f;
    const float margin = t.speculation + relative_motion(state, contact);
    // What has two points gets no third.
    if (way < t.keep && (contact.manifold.count == 2 || margin + way <= kept.margin))
    {
        follow(kept, a, b, contact.manifold);
        return;
    }
    const float wide_margin = margin + 0.5f * t.keep;
    const Manifold old = contact.manifold;
    contact.manifold =
        world_manifold(state, contact, pose_at_start(state, contact.body_a), pose_at_start(state, contact.body_b), wide_margin);
    carry_impulses(old, contact.manifold);
    contact.flags &= ~contact_flag::kept;
    if (!can_keep(state, contact))
        return;
    contact.flags |= contact_flag::kept;
    keep(kept, a, b, contact.manifold, wide_margin);
}

FollowedScene followed_scene(const StepContext& ctx)
{
    const Tolerances& t = ctx.scene.tolerances;
    return {ctx.state.sims.data(), &ctx.state.contacts[0], ctx.state.kept_manifolds.data(), surely * t.keep, t.slop,
            t.speculation};
}

Manifold manifold_at_start(const SceneState& state, int index)
{
    const Contact& contact = state.contacts[index];
    Manifold m = contact.manifold;
    if ((contact.flags & contact_flag::followed) != 0)
        follow(state.kept_manifolds[static_cast<std::size_t>(index)], sim_of(state, contact.body_a),
               sim_of(state, contact.body_b), m);
    return m;
}

void catch_up(SceneState& state, int index)
{
    if ((state.contacts[index].flags & contact_flag::followed) == 0)
        return;
    state.contacts[index].manifold = manifold_at_start(state, index);
    state.contacts[index].flags &= ~contact_flag::followed;
}

bool stays_apart(const StepContext& ctx, int index)
{
    const Contact& contact = ctx.state.contacts[index];
    return (contact.flags & contact_flag::plain) != 0 &&
           (contact.manifold.count == 0 || least_separation(manifold_at_start(ctx.state, index)) >
                                               relative_motion(ctx.state, contact) + 0.1f * ctx.scene.tolerances.speculation);
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
    follow(state.kept_manifolds[static_cast<std::size_t>(index)], before(contact.body_a), before(contact.body_b), m);
    return m;
}

void settle_manifold(SceneState& state, int index)
{
    state.contacts[index].manifold = settled_manifold(state, index);
    state.contacts[index].flags &= ~contact_flag::followed;
}

} // namespace carom::internal
