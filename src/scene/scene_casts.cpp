// Shape casts: the first time at which a moving shape meets one at rest is found as that of bodies in flight is.

#include "carom/scene.h"
#include "collision/manifold.h"
#include "collision/time_of_impact.h"
#include "dynamics/narrowphase/contact_update.h"
#include "geometry/surface.h"
#include "scene/access.h"
#include "scene/query_visits.h"

#include <algorithm>
#include <cmath>

namespace carom {

using namespace internal;

namespace {

constexpr float most_turn = 6.2831855f; // rad
constexpr float least_depth = 1e-5f;    // of the size: rounding makes what touches overlap by less

bool is_before(const CastHit& a, const CastHit& b)
{
    if (a.fraction != b.fraction)
        return a.fraction < b.fraction;
    return a.depth != b.depth ? a.depth > b.depth : a.shape < b.shape;
}

FramePath path_at(const Pose& pose, const Position& origin)
{
    FramePath path;
    path.center.x = pose.position.x - origin.x;
    path.center.y = pose.position.y - origin.y;
    path.c = static_cast<double>(pose.rotation.c);
    path.s = static_cast<double>(pose.rotation.s);
    return path;
}

// One leaf of a shape on its way.
class LeafCast
{
public:
    LeafCast(const SceneState& state, const LeafView& leaf, const CastWay& way)
        : m_state(state), m_leaf(leaf), m_way(way), m_path(path_at(way.start, way.start.position))
    {
        m_path.center.vx = static_cast<double>(way.translation.x);
        m_path.center.vy = static_cast<double>(way.translation.y);
        m_path.w = static_cast<double>(way.turn);
        const FloatBox box = box_of(outer_bounds(leaf, way.start));
        m_ray = {0.5 * (static_cast<double>(box.lx) + static_cast<double>(box.ux)),
                 0.5 * (static_cast<double>(box.ly) + static_cast<double>(box.uy)), m_path.center.vx, m_path.center.vy};
        m_half = {0.5f * (box.ux - box.lx), 0.5f * (box.uy - box.ly)};
        if (way.turn == 0)
            return;
        m_ray.ox = way.start.position.x;
        m_ray.oy = way.start.position.y;
        m_half.x = m_half.y = leaf_extent(leaf, {});
    }

    /// Whether the box is on the way.
    bool operator()(const FloatBox& b) const
    {
        return m_ray(round_outwards(static_cast<double>(b.lx) - static_cast<double>(m_half.x),
                                    static_cast<double>(b.ly) - static_cast<double>(m_half.y),
                                    static_cast<double>(b.ux) + static_cast<double>(m_half.x),
                                    static_cast<double>(b.uy) + static_cast<double>(m_half.y)));
    }

    /// Ends the way there: shapes that are met later do not count any more, those that are met at the same time do.
    void end_at(float fraction) { m_ray.reach = static_cast<double>(std::nextafter(fraction, 2.0f)); }

    [[nodiscard]] std::optional<CastHit> meet(int shape) const
    {
        const Pose pose = pose_of(m_state, shape);
        const LeafView other = leaf_view(m_state, shape);
        if (const std::optional<CastHit> hit = overlap(shape, pose, other))
            return hit;
        const std::optional<Touch> touch =
            first_touch(other, path_at(pose, m_way.start.position), m_leaf, m_path, m_ray.reach, 0);
        if (!touch)
            return std::nullopt;
        return CastHit{.shape = shape_id(m_state, shape),
                       .point = {m_way.start.position.x + touch->x, m_way.start.position.y + touch->y},
                       .normal = {static_cast<float>(touch->nx), static_cast<float>(touch->ny)},
                       .fraction = static_cast<float>(touch->time)};
    }

private:
    [[nodiscard]] std::optional<CastHit> overlap(int shape, const Pose& pose, const LeafView& other) const
    {
        const LocalManifold m = collide(other, m_leaf, relative_pose(pose, m_way.start), 0);
        const float depth = -m.least_separation();
        if (depth <= least_depth * static_cast<float>(probe_size(m_leaf)))
            return std::nullopt;
        const LocalPoint& deepest = m.count > 1 && m.points[1].separation < m.points[0].separation ? m.points[1] : m.points[0];
        return CastHit{.shape = shape_id(m_state, shape),
                       .point = transform(pose, deepest.on_a),
                       .normal = rotate(pose.rotation, m.normal),
                       .depth = depth,
                       .overlaps = true};
    }

    const SceneState& m_state;
    LeafView m_leaf;
    const CastWay& m_way;
    FramePath m_path;
    RayBox m_ray{};
    Vec2 m_half{}; ///< of the box about the point that goes along the ray
};

// Visits the hits of all leaves of the shape until `visit` returns false; it is given the cast, to end it sooner.
template <class Visit>
void cast(const char* function, const SceneState& state, const Geometry& geometry, const CastWay& way, const QueryFilter& filter,
          Visit&& visit)
{
    const Checker check{function};
    Geometry normal = geometry;
    if (!check.finite("way.start.position", way.start.position) || !check.finite("way.start.rotation", way.start.rotation.c) ||
        !check.finite("way.start.rotation", way.start.rotation.s) || !check.finite("way.translation", way.translation) ||
        !check.finite("way.turn", way.turn) ||
        !check.holds(std::fabs(way.turn) <= most_turn, "way.turn", std::to_string(way.turn), "must be within a whole turn") ||
        !normalize_bounded(function, normal))
        return;
    LeafStore store;
    bool goes_on = true;
    for (const Leaf& leaf : make_leaves(normal, store))
    {
        LeafCast on_way(state, view(leaf, store), way);
        const auto meet = [&](int shape)
        {
            if (const std::optional<CastHit> hit = on_way.meet(shape))
                goes_on = visit(on_way, *hit);
            return goes_on;
        };
        if (goes_on)
            visit_leaves(state, filter, [&](const FloatBox& box) { return on_way(box); }, meet);
    }
}

} // namespace

std::optional<CastHit> Scene::shapecast_closest(const Geometry& geometry, const CastWay& way, const QueryFilter& filter) const
{
    std::optional<CastHit> best;
    cast("Scene::shapecast_closest", m_data->state, geometry, way, filter,
         [&](LeafCast& on_way, const CastHit& hit)
         {
             if (!best || is_before(hit, *best))
                 best = hit;
             on_way.end_at(best->fraction);
             return true;
         });
    return best;
}

std::vector<CastHit> Scene::shapecast_all(const Geometry& geometry, const CastWay& way, const QueryFilter& filter) const
{
    std::vector<CastHit> hits;
    cast("Scene::shapecast_all", m_data->state, geometry, way, filter,
         [&](const LeafCast&, const CastHit& hit)
         {
             hits.push_back(hit);
             return true;
         });
    return first_of_each(std::move(hits), is_before);
}

bool Scene::shapecast_any(const Geometry& geometry, const CastWay& way, const QueryFilter& filter) const
{
    bool found = false;
    cast("Scene::shapecast_any", m_data->state, geometry, way, filter,
         [&](const LeafCast&, const CastHit&)
         {
             found = true;
             return false;
         });
    return found;
}

} // namespace carom
