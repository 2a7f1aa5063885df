// Queries: rays, overlaps, closest points, and the list of contacts. All are const; each call returns its own results.

#include "carom/scene.h"
#include "collision/manifold.h"
#include "dynamics/broadphase/half_space_box.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/narrowphase/manifold_cache.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "geometry/bounds.h"
#include "geometry/leaf_traits.h"
#include "geometry/ray.h"
#include "geometry/surface.h"
#include "scene/access.h"
#include "scene/query_visits.h"

#include <algorithm>
#include <cmath>

namespace carom {

using namespace internal;

namespace {

bool check_ray(const char* function, Position origin, Vec2 translation)
{
    const Checker check{function};
    return check.finite("origin", origin) && check.finite("translation", translation);
}

std::optional<RayHit> hit_leaf(const SceneState& state, int shape, Position origin, Vec2 translation)
{
    const Pose pose = pose_of(state, shape);
    const std::optional<LeafHit> hit =
        ray_leaf(leaf_view(state, shape), inverse_transform(pose, origin), inverse_rotate(pose.rotation, translation));
    if (!hit)
        return std::nullopt;
    return RayHit{shape_id(state, shape), origin + hit->fraction * translation, rotate(pose.rotation, hit->normal),
                  hit->fraction};
}

bool is_nearer(const RayHit& a, const RayHit& b)
{
    return a.fraction != b.fraction ? a.fraction < b.fraction : a.shape < b.shape;
}

std::vector<ShapeId> sorted_unique(std::vector<ShapeId> ids)
{
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
}

std::vector<ShapeId> overlap_leaf(const SceneState& state, const LeafView& leaf, const Pose& pose, const QueryFilter& filter)
{
    std::vector<ShapeId> ids;
    const FloatBox box = box_of(outer_bounds(leaf, pose));
    visit_box(state, filter, box,
              [&](int shape)
              {
                  const LocalManifold m = collide(leaf_view(state, shape), leaf, relative_pose(pose_of(state, shape), pose), 0);
                  if (m.count > 0)
                      ids.push_back(shape_id(state, shape));
                  return true;
              });
    return ids;
}

} // namespace

std::optional<RayHit> Scene::raycast_closest(Position origin, Vec2 translation, const QueryFilter& filter) const
{
    if (!check_ray("Scene::raycast_closest", origin, translation))
        return std::nullopt;
    const SceneState& state = m_data->state;
    std::optional<RayHit> best;
    RayBox ray{origin.x, origin.y, translation.x, translation.y};
    visit_leaves(
        state, filter, [&](const FloatBox& b) { return ray(b); },
        [&](int shape)
        {
            const std::optional<RayHit> hit = hit_leaf(state, shape, origin, translation);
            if (hit && (!best || is_nearer(*hit, *best)))
            {
                best = hit;
                ray.reach = hit->fraction;
            }
            return true;
        });
    return best;
}

std::vector<RayHit> Scene::raycast_all(Position origin, Vec2 translation, const QueryFilter& filter) const
{
    std::vector<RayHit> hits;
    if (!check_ray("Scene::raycast_all", origin, translation))
        return hits;
    const SceneState& state = m_data->state;
    const RayBox ray{origin.x, origin.y, translation.x, translation.y};
    visit_leaves(state, filter, ray,
                 [&](int shape)
                 {
                     if (const std::optional<RayHit> hit = hit_leaf(state, shape, origin, translation))
                         hits.push_back(*hit);
                     return true;
                 });
    return first_of_each(std::move(hits), is_nearer);
}

bool Scene::raycast_any(Position origin, Vec2 translation, const QueryFilter& filter) const
{
    if (!check_ray("Scene::raycast_any", origin, translation))
        return false;
    const SceneState& state = m_data->state;
    bool found = false;
    const RayBox ray{origin.x, origin.y, translation.x, translation.y};
    visit_leaves(state, filter, ray,
                 [&](int shape)
                 {
                     found = hit_leaf(state, shape, origin, translation).has_value();
                     return !found;
                 });
    return found;
}

std::vector<ShapeId> Scene::overlap_point(Position point, const QueryFilter& filter) const
{
    std::vector<ShapeId> ids;
    if (!Checker{"Scene::overlap_point"}.finite("point", point))
        return ids;
    const SceneState& state = m_data->state;
    visit_box(state, filter, round_outwards(point.x, point.y, point.x, point.y),
              [&](int shape)
              {
                  const Vec2 local = inverse_transform(pose_of(state, shape), point);
                  const auto surface = surface_at<float>(leaf_view(state, shape), local.x, local.y);
                  if (surface && surface->distance <= 0)
                      ids.push_back(shape_id(state, shape));
                  return true;
              });
    return sorted_unique(std::move(ids));
}

std::vector<ShapeId> Scene::overlap_box(const Box& b, const QueryFilter& filter) const
{
    const Checker check{"Scene::overlap_box"};
    if (!check.finite("box.lower", b.lower) || !check.finite("box.upper", b.upper) ||
        !check.holds(b.lower.x <= b.upper.x && b.lower.y <= b.upper.y, "box.upper", internal::to_text(b.upper),
                     "must not be below box.lower"))
        return {};
    const Position center{0.5 * (b.lower.x + b.upper.x), 0.5 * (b.lower.y + b.upper.y)};
    // A box without width or height is a very thin one.
    const Vec2 half = {std::max(static_cast<float>(0.5 * (b.upper.x - b.lower.x)), 1e-5f),
                       std::max(static_cast<float>(0.5 * (b.upper.y - b.lower.y)), 1e-5f)};
    return overlap_shape(carom::box(half.x, half.y), {center, {}}, filter);
}

std::vector<ShapeId> Scene::overlap_shape(const Geometry& geometry, const Pose& pose, const QueryFilter& filter) const
{
    constexpr const char* function = "Scene::overlap_shape";
    const Checker check{function};
    Geometry normal = geometry;
    if (!check.finite("pose.position", pose.position) || !check.finite("pose.rotation", pose.rotation.c) ||
        !check.finite("pose.rotation", pose.rotation.s) || !normalize_bounded(function, normal))
        return {};
    LeafStore store;
    std::vector<ShapeId> ids;
    for (const Leaf& leaf : make_leaves(normal, store))
    {
        const std::vector<ShapeId> found = overlap_leaf(m_data->state, view(leaf, store), pose, filter);
        ids.insert(ids.end(), found.begin(), found.end());
    }
    return sorted_unique(std::move(ids));
}

std::optional<PointHit> Scene::closest_point(Position point, float max_distance, const QueryFilter& filter) const
{
    const Checker check{"Scene::closest_point"};
    if (!check.finite("point", point) || !check.not_negative("max_distance", max_distance))
        return std::nullopt;
    const SceneState& state = m_data->state;
    std::optional<PointHit> best;
    const double reach = max_distance;
    visit_box(state, filter, round_outwards(point.x - reach, point.y - reach, point.x + reach, point.y + reach),
              [&](int shape)
              {
                  const Pose pose = pose_of(state, shape);
                  const Vec2 local = inverse_transform(pose, point);
                  const auto s = surface_at<float>(leaf_view(state, shape), local.x, local.y);
                  if (!s || s->distance > max_distance)
                      return true;
                  const Vec2 n = rotate(pose.rotation, {s->nx, s->ny});
                  const PointHit hit{shape_id(state, shape), point - s->distance * n, n, s->distance};
                  if (!best || hit.distance < best->distance || (hit.distance == best->distance && hit.shape < best->shape))
                      best = hit;
                  return true;
              });
    return best;
}

// ------------------------------------------------------------------------------------------------------------------------------------

namespace {

ContactInfo describe(const SceneState& state, int index)
{
    const Contact& contact = state.contacts[index];
    const Manifold manifold = settled_manifold(state, index);
    ContactInfo info;
    info.shape_a = shape_id(state, contact.shape_a);
    info.shape_b = shape_id(state, contact.shape_b);
    info.normal = manifold.normal;
    info.point_count = manifold.count;
    info.touching = touches(contact);
    info.color = contact.color;
    const Position center = state.sims[static_cast<std::size_t>(contact.body_a)].center;
    for (int i = 0; i < manifold.count; ++i)
    {
        const ManifoldPoint& p = manifold.points[i];
        const PointImpulses& impulses = impulses_of(state, index).points[i];
        info.points[i] = {center + p.anchor_a, p.separation, impulses.total_normal, impulses.total_tangent};
    }
    return info;
}

bool is_listed(const Contact& contact) { return (contact.flags & contact_flag::trigger) == 0 && contact.manifold.count > 0; }

} // namespace

std::vector<ContactInfo> Scene::contacts() const
{
    std::vector<ContactInfo> list;
    const SceneState& state = m_data->state;
    for (int i = 0; i < state.contacts.capacity(); ++i)
    {
        if (state.contacts.is_live(i) && is_listed(state.contacts[i]))
            list.push_back(describe(state, i));
    }
    return list;
}

std::vector<ContactInfo> ConstBody::contacts() const
{
    std::vector<ContactInfo> list;
    if (!check_live(*m_data, "Body::contacts", "body", m_id))
        return list;
    const SceneState& state = m_data->state;
    for (const int index : contacts_of(state, slot_of(m_id)))
    {
        const Contact& contact = state.contacts[index];
        if (is_listed(contact) && touches(contact))
            list.push_back(describe(state, index));
    }
    return list;
}

namespace {

// The contact of two leaves at the current poses of their bodies.
ContactInfo describe_touch(const SceneState& state, int own, int other, float slop)
{
    Contact contact;
    contact.shape_a = own;
    contact.shape_b = other;
    contact.body_a = state.shapes[own].body;
    contact.body_b = state.shapes[other].body;
    const Manifold m =
        world_manifold(state, contact, pose_at_start(state, contact.body_a), pose_at_start(state, contact.body_b), slop);
    ContactInfo info;
    info.shape_a = shape_id(state, own);
    info.shape_b = shape_id(state, other);
    info.normal = m.normal;
    info.touching = m.count > 0;
    info.point_count = m.count;
    const Position center = state.sims[static_cast<std::size_t>(contact.body_a)].center;
    for (int i = 0; i < m.count; ++i)
        info.points[i] = {center + m.points[i].anchor_a, m.points[i].separation, 0, 0};
    return info;
}

// Visits leaves whose boxes a leaf may touch.
template <class Visit>
void visit_near_leaf(const SceneState& state, int leaf, float slop, Visit&& visit)
{
    const QueryFilter all{};
    if (!traits_of(state.shapes[leaf].leaf).is_bounded)
        visit_leaves(state, all, [&](const FloatBox& node) { return reaches_half_space(state, leaf, node, slop); }, visit);
    else
        visit_box(state, all, grow(box_of(outer_bounds(leaf_view(state, leaf), pose_of(state, leaf))), slop), visit);
}

} // namespace

std::vector<ContactInfo> ConstBody::touches_now() const
{
    std::vector<ContactInfo> list;
    if (!check_live(*m_data, "Body::touches_now", "body", m_id))
        return list;
    const SceneState& state = m_data->state;
    const float slop = m_data->tolerances.slop;
    const auto meet = [&](int own, int other)
    {
        if (state.shapes[own].trigger || state.shapes[other].trigger || !may_collide(state, own, other))
            return true;
        if (const ContactInfo info = describe_touch(state, own, other, slop); info.touching)
            list.push_back(info);
        return true;
    };
    for_each_leaf(state, slot_of(m_id),
                  [&](int own) { visit_near_leaf(state, own, slop, [&](int other) { return meet(own, other); }); });
    return list;
}

} // namespace carom
