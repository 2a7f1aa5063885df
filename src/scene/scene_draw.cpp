// Debug draw: the scene as primitives, for the user's DebugDraw.

#include "carom/scene.h"
#include "dynamics/narrowphase/manifold_cache.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/state/body_store.h"
#include "geometry/bounds.h"
#include "geometry/leaf_traits.h"
#include "scene/access.h"

#include <algorithm>

namespace carom {

using namespace internal;

namespace {

class Painter
{
public:
    Painter(const SceneData& data, DebugDraw& draw, const DebugDrawOptions& options)
        : m_state(data.state), m_draw(draw), m_options(options), m_view(round_outwards(options.view))
    {}

    void shapes() const
    {
        for_each_body(
            [&](int body)
            {
                for_each_leaf(m_state, body,
                              [&](int shape)
                              {
                                  const bool shown = m_state.shapes[shape].trigger ? m_options.triggers : m_options.shapes;
                                  if (shown)
                                      draw_leaf(role_of(body, shape), leaf_view(m_state, shape), pose_of(body));
                                  if (m_options.boxes && m_state.broad_phase.has(shape))
                                      draw_box(m_state.broad_phase.box(shape), DrawRole::Box);
                              });
            });
    }

    void bodies() const
    {
        for_each_body(
            [&](int body)
            {
                const BodySim& sim = m_state.sims[static_cast<std::size_t>(body)];
                if (m_options.centers && m_state.bodies[body].type == BodyType::Dynamic)
                    m_draw.point(DrawRole::CenterOfMass, sim.center);
                if (m_options.velocities && sim.velocity != Vec2{})
                    m_draw.line(DrawRole::Velocity, sim.center, sim.center + m_options.velocity_scale * sim.velocity);
            });
    }

    void joints() const
    {
        for (int j = 0; j < m_state.joints.capacity(); ++j)
        {
            if (!m_state.joints.is_live(j))
                continue;
            const JointRecord& joint = m_state.joints[j];
            const Position a = anchor(joint.body_a, joint.anchor_a);
            const Position b = anchor(joint.body_b, joint.anchor_b);
            m_draw.line(DrawRole::Joint, a, b);
            m_draw.point(DrawRole::Joint, a);
            m_draw.point(DrawRole::Joint, b);
        }
    }

    void contacts() const
    {
        for (int i = 0; i < m_state.contacts.capacity(); ++i)
        {
            if (!m_state.contacts.is_live(i) || !touches(m_state.contacts[i]) ||
                (m_state.contacts[i].flags & contact_flag::trigger) != 0)
                continue;
            const Contact& contact = m_state.contacts[i];
            const Position center = m_state.sims[static_cast<std::size_t>(contact.body_a)].center;
            const Manifold manifold = settled_manifold(m_state, i);
            for (int p = 0; p < manifold.count; ++p)
                draw_contact(manifold, manifold.points[p], impulses_of(m_state, i).points[p], center);
        }
    }

    // Draws the box around the bodies of each awake island.
    void islands() const
    {
        std::vector<std::uint8_t> seen(static_cast<std::size_t>(m_state.bodies.capacity()));
        std::vector<std::int32_t> island;
        for (const std::int32_t first : m_state.awake_bodies)
        {
            if (seen[static_cast<std::size_t>(first)] != 0 || m_state.bodies[first].type != BodyType::Dynamic)
                continue;
            island.clear();
            gather_island(m_state, first, seen, island, [](int) { return true; });
            FloatBox box;
            for (const std::int32_t body : island)
                for_each_leaf(m_state, body, [&](int shape) { box = unite(box, m_state.broad_phase.box(shape)); });
            if (box.lx <= box.ux)
                draw_box(box, DrawRole::Island);
        }
    }

private:
    template <class Visit>
    void for_each_body(Visit&& visit) const
    {
        for (int body = 0; body < m_state.bodies.capacity(); ++body)
        {
            if (m_state.bodies.is_live(body))
                visit(body);
        }
    }

    [[nodiscard]] Pose pose_of(int body) const { return m_state.sims[static_cast<std::size_t>(body)].pose(); }
    [[nodiscard]] Position anchor(int body, Vec2 local) const
    {
        return body == none ? Position(local) : transform(pose_of(body), local);
    }

    [[nodiscard]] DrawRole role_of(int body, int shape) const
    {
        const BodyRecord& record = m_state.bodies[body];
        if (!record.enabled)
            return DrawRole::DisabledShape;
        if (m_state.shapes[shape].trigger)
            return DrawRole::Trigger;
        if (record.type == BodyType::Static)
            return DrawRole::StaticShape;
        if (record.type == BodyType::Kinematic)
            return DrawRole::KinematicShape;
        return internal::is_awake(m_state, body) ? DrawRole::AwakeShape : DrawRole::SleepingShape;
    }

    void draw_leaf(DrawRole role, const LeafView& v, const Pose& pose) const
    {
        const Leaf& leaf = *v.leaf;
        if (traits_of(leaf).is_bounded && !overlaps(box_of(outer_bounds(v, pose)), m_view))
            return;
        const Position p0 = transform(pose, leaf.p0);
        switch (leaf.type)
        {
        case LeafType::HalfSpace: draw_half_space(role, leaf, pose); break;
        case LeafType::Circle: m_draw.circle(role, p0, leaf.r0, pose.rotation); break;
        case LeafType::Polygon:
        {
            std::vector<Position> vertices;
            for (int i = 0; i < leaf.count; ++i)
                vertices.push_back(transform(pose, v.points[i]));
            m_draw.polygon(role, vertices, leaf.r0);
            break;
        }
        case LeafType::Capsule:
        case LeafType::Segment:
            if (leaf.r0 > 0)
                m_draw.capsule(role, p0, transform(pose, leaf.p1), leaf.r0, leaf.r1);
            else
                m_draw.line(role, p0, transform(pose, leaf.p1));
            break;
        case LeafType::Arc:
            m_draw.arc(role, p0, leaf.arc_radius, v.span->start_angle + pose.rotation.angle(), v.span->sweep, leaf.r0);
            break;
        }
    }

    // Draws as much of the boundary line as the view may show.
    void draw_half_space(DrawRole role, const Leaf& leaf, const Pose& pose) const
    {
        const Vec2 n = rotate(pose.rotation, leaf.p0);
        const Position middle{0.5 * (m_options.view.lower.x + m_options.view.upper.x),
                              0.5 * (m_options.view.lower.y + m_options.view.upper.y)};
        const double size = std::min(
            std::max(m_options.view.upper.x - m_options.view.lower.x, m_options.view.upper.y - m_options.view.lower.y), 1e6);
        const double height =
            n.x * (middle.x - pose.position.x) + n.y * (middle.y - pose.position.y) - static_cast<double>(leaf.r0);
        const Position foot{middle.x - height * n.x, middle.y - height * n.y};
        const Vec2 along = static_cast<float>(size) * perp(n);
        m_draw.line(role, foot - along, foot + along);
    }

    void draw_box(const FloatBox& b, DrawRole role) const
    {
        if (!overlaps(b, m_view))
            return;
        const Position corners[4] = {{b.lx, b.ly}, {b.ux, b.ly}, {b.ux, b.uy}, {b.lx, b.uy}};
        for (int i = 0; i < 4; ++i)
            m_draw.line(role, corners[i], corners[(i + 1) % 4]);
    }

    void draw_contact(const Manifold& m, const ManifoldPoint& p, const PointImpulses& impulses, Position center) const
    {
        const Position at = center + p.anchor_a;
        if (m_options.contacts)
            m_draw.point(DrawRole::Contact, at);
        if (m_options.normals)
            m_draw.line(DrawRole::ContactNormal, at, at + m_options.velocity_scale * m.normal);
        if (m_options.impulses)
            m_draw.line(DrawRole::Impulse, at, at + (m_options.impulse_scale * impulses.total_normal) * m.normal);
        if (m_options.friction)
            m_draw.line(DrawRole::Friction, at, at + (m_options.impulse_scale * impulses.total_tangent) * perp(m.normal));
    }

    const SceneState& m_state;
    DebugDraw& m_draw;
    const DebugDrawOptions& m_options;
    FloatBox m_view;
};

} // namespace

void Scene::debug_draw(DebugDraw& draw, const DebugDrawOptions& options) const
{
    const Painter painter(*m_data, draw, options);
    painter.shapes();
    if (options.joints)
        painter.joints();
    painter.bodies();
    if (options.contacts || options.normals || options.impulses || options.friction)
        painter.contacts();
    if (options.islands)
        painter.islands();
}

} // namespace carom
