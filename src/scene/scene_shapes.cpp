// Shapes: creation, changes, destruction.

#include "carom/scene.h"
#include "core/rounding.h"
#include "dynamics/forces/fields.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/state/body_store.h"
#include "geometry/limits.h"
#include "geometry/surface.h"
#include "scene/access.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

namespace carom {

using namespace internal;

namespace {

bool check_curve(const Checker& check, const RestitutionCurve& curve)
{
    if (!check.holds(curve.count <= curve.points.size(), "RestitutionCurve::count", std::to_string(curve.count),
                     "must be at most 8"))
        return false;
    for (std::uint32_t i = 0; i < curve.count; ++i)
    {
        const RestitutionCurve::Point& p = curve.points[i];
        if (!check.not_negative("RestitutionCurve::points.speed", p.speed) ||
            !check.in_range("RestitutionCurve::points.restitution", p.restitution, 0, 1) ||
            !check.holds(i == 0 || p.speed > curve.points[i - 1].speed, "RestitutionCurve::points.speed",
                         internal::to_text(p.speed), "must be greater than the one before"))
            return false;
    }
    return true;
}

bool check_def(const char* function, const ShapeDef& def)
{
    const Checker check{function};
    return check.not_negative("ShapeDef::density", def.density) && check.not_negative("ShapeDef::friction", def.friction) &&
           check.in_range("ShapeDef::restitution", def.restitution, 0, 1) && check_curve(check, def.restitution_curve) &&
           check.not_negative("ShapeDef::rolling_resistance", def.rolling_resistance) &&
           check.finite("ShapeDef::surface_speed", def.surface_speed) && check.finite("ShapeDef::one_way", def.one_way) &&
           check.not_negative("Kick::speed", def.kick.speed) && check.not_negative("Kick::threshold", def.kick.threshold) &&
           check.not_negative("Kick::cooldown", def.kick.cooldown) && check.finite("Field::force", def.field.force) &&
           check.finite("Field::acceleration", def.field.acceleration) && check.not_negative("Field::drag", def.field.drag) &&
           check.holds(def.trigger || !acts(def.field), "ShapeDef::field", "set on a shape that is not a trigger",
                       "acts inside triggers only");
}

// Normalizes and checks the geometry of a shape.
bool check_geometry(const char* function, Geometry& geometry, const ShapeDef& def)
{
    return normalize_geometry(function, geometry) && check_reach(function, geometry) &&
           (def.trigger || check_mass(function, geometry, def.density));
}

// Checks what the body's type allows.
bool check_placement(const SceneData& data, const char* function, int body, const Geometry& geometry)
{
    const Checker check{function};
    const BodyType type = data.state.bodies[body].type;
    const bool massless = std::holds_alternative<Arc>(geometry) || std::holds_alternative<Chain>(geometry);
    const bool half_space = std::holds_alternative<HalfSpace>(geometry);
    return check.holds(!massless || type != BodyType::Dynamic, "geometry", "an arc or chain on a dynamic body",
                       "arcs and chains carry no mass: static and kinematic bodies only") &&
           check.holds(!half_space || type == BodyType::Static, "geometry", "a half-space on a body that moves",
                       "half-spaces belong to static bodies");
}

void write_def(ShapeRecord& record, const ShapeDef& def)
{
    record.trigger = def.trigger;
    record.yields_material = def.yields_material;
    record.density = def.density;
    record.friction = def.friction;
    record.restitution = def.restitution;
    record.rolling_resistance = def.rolling_resistance;
    record.surface_speed = def.surface_speed;
    record.filter = def.filter;
}

bool has_rare_traits(const ShapeDef& def)
{
    return def.restitution_curve.count > 0 || acts(def.field) || def.one_way != Vec2{} || def.kick != Kick{};
}

void drop_rare_traits(SceneState& state, std::int32_t& place)
{
    if (place != none)
        state.rare_traits.destroy(std::exchange(place, none));
}

// Writes the traits of a public shape. The time from which its kick may fire again is kept.
void write_rare_traits(SceneState& state, std::int32_t& place, const ShapeDef& def)
{
    if (!has_rare_traits(def))
    {
        drop_rare_traits(state, place);
        return;
    }
    if (place == none)
        place = state.rare_traits.create({});
    RareTraits& traits = state.rare_traits[place];
    traits.restitution_curve = def.restitution_curve;
    traits.field = def.field;
    traits.one_way = normalize(def.one_way);
    traits.kick = def.kick;
}

ShapeDef read_def(const SceneState& state, int shape, std::uint64_t user_data)
{
    const ShapeRecord& record = state.shapes[shape];
    const RareTraits& rare = rare_traits_of(state, record);
    return {.density = record.density,
            .friction = record.friction,
            .restitution = record.restitution,
            .restitution_curve = rare.restitution_curve,
            .rolling_resistance = record.rolling_resistance,
            .surface_speed = record.surface_speed,
            .one_way = rare.one_way,
            .kick = rare.kick,
            .yields_material = record.yields_material,
            .filter = record.filter,
            .trigger = record.trigger,
            .field = rare.field,
            .user_data = user_data};
}

template <class Visit>
void for_each_own_leaf(const SceneState& state, int shape, Visit&& visit)
{
    if (state.shapes[shape].has_leaf)
    {
        visit(shape);
        return;
    }
    for (int piece = state.shapes[shape].next_piece; piece != none;)
    {
        const int next = state.shapes[piece].next_piece;
        visit(piece);
        piece = next;
    }
}

// The geometry in its normalized form.
Geometry geometry_of(const SceneState& state, int shape)
{
    std::vector<LeafView> leaves;
    for_each_own_leaf(state, shape, [&](int leaf) { leaves.push_back(leaf_view(state, leaf)); });
    return state.shapes[shape].has_leaf ? internal::geometry_of(leaves.front()) : chain_of(leaves);
}

void keep_callbacks(SceneData& data, int shape, std::shared_ptr<const ShapeCallbacks> callbacks)
{
    const auto slot = static_cast<std::size_t>(shape);
    if (callbacks == nullptr && slot >= data.callbacks.size())
        return;
    grow(data.callbacks, slot + 1);
    data.callback_count += (callbacks ? 1 : 0) - (data.callbacks[slot] ? 1 : 0);
    data.callbacks[slot] = std::move(callbacks);
}

} // namespace

namespace internal {

void add_leaves(SceneData& data, int shape, const Geometry& geometry)
{
    SceneState& state = data.state;
    const std::vector<Leaf> leaves = make_leaves(geometry, state.leaf_store);
    const bool enabled = state.bodies[state.shapes[shape].body].enabled;
    if (!std::holds_alternative<Chain>(geometry))
    {
        state.shapes[shape].leaf = leaves.front();
        state.shapes[shape].has_leaf = true;
        if (enabled)
            add_to_broad_phase(data, shape);
        return;
    }
    int last = none;
    for (const Leaf& leaf : leaves)
    {
        ShapeRecord piece = state.shapes[shape];
        piece.leaf = leaf;
        piece.has_leaf = true;
        piece.owner = shape;
        piece.next_piece = none;
        piece.next_shape = none;
        const int slot = state.shapes.create(piece);
        (last == none ? state.shapes[shape] : state.shapes[last]).next_piece = slot;
        last = slot;
        if (enabled)
            add_to_broad_phase(data, slot);
    }
}

void remove_leaves(SceneData& data, int shape)
{
    SceneState& state = data.state;
    for_each_own_leaf(state, shape,
                      [&](int leaf)
                      {
                          destroy_contacts_of_shape(data, leaf);
                          state.broad_phase.remove(leaf);
                          state.leaf_store.release(state.shapes[leaf].leaf);
                          if (leaf != shape)
                              state.shapes.destroy(leaf);
                      });
    state.shapes[shape].has_leaf = false;
    state.shapes[shape].next_piece = none;
}

void unlink_shape(SceneData& data, int shape)
{
    SceneState& state = data.state;
    BodyRecord& body = state.bodies[state.shapes[shape].body];
    int before = none;
    std::int32_t* link = &body.first_shape;
    while (*link != shape)
    {
        before = *link;
        link = &state.shapes[*link].next_shape;
    }
    *link = state.shapes[shape].next_shape;
    if (body.last_shape == shape)
        body.last_shape = before;
}

void destroy_shape(SceneData& data, int shape)
{
    remove_leaves(data, shape);
    unlink_shape(data, shape);
    keep_callbacks(data, shape, nullptr);
    drop_rare_traits(data.state, data.state.shapes[shape].rare_traits);
    data.state.shapes.destroy(shape);
}

} // namespace internal

ShapeId Scene::create_shape(BodyId body, const Geometry& geometry, const ShapeDef& def)
{
    const internal::RoundToNearest rounding;
    constexpr const char* function = "Scene::create_shape";
    if (!check_live(*m_data, function, "body", body))
        return {};
    const int body_slot = slot_of(body);
    Geometry normal = geometry;
    if (!check_def(function, def) || !check_placement(*m_data, function, body_slot, geometry) ||
        !check_geometry(function, normal, def))
        return {};
    SceneState& state = m_data->state;
    ShapeRecord record;
    record.body = body_slot;
    write_def(record, def);
    write_rare_traits(state, record.rare_traits, def);
    const int slot = state.shapes.create(record);
    state.shapes[slot].owner = slot;
    // Appends to the body's list, so that shapes keep the order in which they were created.
    BodyRecord& owner = state.bodies[body_slot];
    (owner.last_shape == none ? owner.first_shape : state.shapes[owner.last_shape].next_shape) = slot;
    owner.last_shape = slot;
    add_leaves(*m_data, slot, normal);
    grow(m_data->shape_user_data, static_cast<std::size_t>(state.shapes.capacity()));
    m_data->shape_user_data[static_cast<std::size_t>(slot)] = def.user_data;
    include_mass(state, body_slot, slot);
    return shape_id(state, slot);
}

void Scene::destroy(ShapeId id)
{
    if (!check_live(*m_data, "Scene::destroy", "shape", id))
        return;
    const int body = m_data->state.shapes[slot_of(id)].body;
    destroy_shape(*m_data, slot_of(id));
    update_mass(m_data->state, body);
    wake_body(*m_data, body);
}

void Scene::set_callbacks(ShapeId id, ShapeCallbacks callbacks)
{
    if (!check_live(*m_data, "Scene::set_callbacks", "shape", id))
        return;
    const bool any = callbacks.on_contact_begin || callbacks.on_impact || callbacks.on_contact_end ||
                     callbacks.on_trigger_enter || callbacks.on_trigger_inside || callbacks.on_trigger_exit;
    keep_callbacks(*m_data, slot_of(id), any ? std::make_shared<const ShapeCallbacks>(std::move(callbacks)) : nullptr);
}

Shape Scene::shape(ShapeId id)
{
    const bool live = check_live(*m_data, "Scene::shape", "shape", id);
    return Shape(m_data, live ? id : ShapeId{});
}

ConstShape Scene::shape(ShapeId id) const
{
    const bool live = check_live(*m_data, "Scene::shape", "shape", id);
    return ConstShape(m_data, live ? id : ShapeId{});
}

std::vector<ShapeId> Scene::inside(ShapeId id) const
{
    std::vector<ShapeId> visitors;
    const SceneState& state = m_data->state;
    if (!check_live(*m_data, "Scene::inside", "trigger", id) ||
        !Checker{"Scene::inside"}.holds(state.shapes[slot_of(id)].trigger, "trigger", internal::to_text(id),
                                        "must be a trigger shape"))
        return visitors;
    for (const std::int32_t index : state.trigger_contacts)
    {
        const Contact& contact = state.contacts[index];
        if (touches(contact) && state.shapes[contact.shape_a].owner == slot_of(id))
            visitors.push_back(shape_id(state, contact.shape_b));
    }
    std::sort(visitors.begin(), visitors.end());
    visitors.erase(std::unique(visitors.begin(), visitors.end()), visitors.end());
    return visitors;
}

// ------------------------------------------------------------------------------------------------------------------------------------

BodyId ConstShape::body() const
{
    return check_live(*m_data, "Shape::body", "shape", m_id) ? body_id(m_data->state, m_data->state.shapes[slot_of(m_id)].body)
                                                             : BodyId{};
}

Geometry ConstShape::geometry() const
{
    return check_live(*m_data, "Shape::geometry", "shape", m_id) ? geometry_of(m_data->state, slot_of(m_id)) : Geometry{};
}

ShapeDef ConstShape::def() const
{
    if (!check_live(*m_data, "Shape::def", "shape", m_id))
        return {};
    return read_def(m_data->state, slot_of(m_id), m_data->shape_user_data[static_cast<std::size_t>(slot_of(m_id))]);
}

bool ConstShape::is_trigger() const
{
    return check_live(*m_data, "Shape::is_trigger", "shape", m_id) && m_data->state.shapes[slot_of(m_id)].trigger;
}

std::uint64_t ConstShape::user_data() const
{
    return check_live(*m_data, "Shape::user_data", "shape", m_id)
               ? m_data->shape_user_data[static_cast<std::size_t>(slot_of(m_id))]
               : 0;
}

Box ConstShape::bounds() const
{
    if (!check_live(*m_data, "Shape::bounds", "shape", m_id))
        return {};
    const SceneState& state = m_data->state;
    const Pose pose = state.sims[static_cast<std::size_t>(state.shapes[slot_of(m_id)].body)].pose();
    Box total{{1e30, 1e30}, {-1e30, -1e30}};
    for_each_own_leaf(state, slot_of(m_id),
                      [&](int leaf)
                      {
                          const Box b = leaf_bounds(leaf_view(state, leaf), pose);
                          total.lower = {std::min(total.lower.x, b.lower.x), std::min(total.lower.y, b.lower.y)};
                          total.upper = {std::max(total.upper.x, b.upper.x), std::max(total.upper.y, b.upper.y)};
                      });
    return total;
}

bool ConstShape::contains(Position point) const
{
    if (!check_live(*m_data, "Shape::contains", "shape", m_id) || !Checker{"Shape::contains"}.finite("point", point))
        return false;
    const SceneState& state = m_data->state;
    const Vec2 local = inverse_transform(state.sims[static_cast<std::size_t>(state.shapes[slot_of(m_id)].body)].pose(), point);
    bool inside = false;
    for_each_own_leaf(state, slot_of(m_id),
                      [&](int leaf)
                      {
                          const auto surface = surface_at<float>(leaf_view(state, leaf), local.x, local.y);
                          inside |= surface && surface->distance <= 0;
                      });
    return inside;
}

void Shape::set_def(const ShapeDef& def)
{
    const internal::RoundToNearest rounding;
    constexpr const char* function = "Shape::set_def";
    if (!check_live(*m_data, function, "shape", m_id) || !check_def(function, def))
        return;
    SceneState& state = m_data->state;
    const int slot = slot_of(m_id);
    if (!def.trigger && !check_mass(function, geometry_of(state, slot), def.density))
        return;
    const ShapeRecord old = state.shapes[slot];
    // A change of what may meet ends the contacts; a change of material only mixes them anew.
    const bool meets_others =
        old.filter != def.filter || old.trigger != def.trigger || rare_traits_of(state, old).one_way != normalize(def.one_way);
    const bool acts_on_others = acts(def.field) && rare_traits_of(state, old).field != def.field;
    write_def(state.shapes[slot], def);
    write_rare_traits(state, state.shapes[slot].rare_traits, def);
    for_each_own_leaf(state, slot,
                      [&](int leaf)
                      {
                          write_def(state.shapes[leaf], def);
                          state.shapes[leaf].rare_traits = state.shapes[slot].rare_traits;
                          if (meets_others)
                          {
                              destroy_contacts_of_shape(*m_data, leaf);
                              state.broad_phase.set_trigger(leaf, def.trigger);
                              state.broad_phase.set_filter(leaf, filter_bits(def.filter));
                          }
                          if (meets_others || acts_on_others)
                              look_again(state, leaf);
                      });
    for_each_contact(state, old.body,
                     [&](int contact)
                     {
                         mix_materials(*m_data, state.contacts[contact]);
                         leave_lane(state, contact);
                     });
    m_data->shape_user_data[static_cast<std::size_t>(slot)] = def.user_data;
    if (old.density != def.density || old.trigger != def.trigger)
        update_mass(state, old.body);
    wake_body(*m_data, old.body);
    for_each_contact(state, old.body, [&](int contact) { wake_body(*m_data, other_body(state.contacts[contact], old.body)); });
}

void Shape::set_geometry(const Geometry& geometry)
{
    const internal::RoundToNearest rounding;
    constexpr const char* function = "Shape::set_geometry";
    if (!check_live(*m_data, function, "shape", m_id))
        return;
    const int slot = slot_of(m_id);
    const int body = m_data->state.shapes[slot].body;
    Geometry normal = geometry;
    if (!check_placement(*m_data, function, body, geometry) ||
        !check_geometry(function, normal, read_def(m_data->state, slot, 0)))
        return;
    remove_leaves(*m_data, slot);
    add_leaves(*m_data, slot, normal);
    update_mass(m_data->state, body);
    wake_body(*m_data, body);
}

void Shape::set_user_data(std::uint64_t user_data)
{
    if (check_live(*m_data, "Shape::set_user_data", "shape", m_id))
        m_data->shape_user_data[static_cast<std::size_t>(slot_of(m_id))] = user_data;
}

} // namespace carom
