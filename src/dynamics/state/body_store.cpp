// Mass, extent and boxes of bodies.

#include "dynamics/state/body_store.h"

#include "dynamics/narrowphase/manifold_cache.h"
#include "dynamics/state/contact_store.h"
#include "geometry/bounds.h"
#include "geometry/leaf_traits.h"
#include "geometry/mass.h"
#include "geometry/surface.h"

#include <algorithm>

namespace carom::internal {

namespace {

LeafMass total_mass(const SceneState& state, int body)
{
    LeafMass total;
    for_each_leaf(state, body,
                  [&](int shape)
                  {
                      const ShapeRecord& record = state.shapes[shape];
                      if (record.trigger)
                          return;
                      const LeafMass part = leaf_mass(leaf_view(state, shape), record.density);
                      total.mass += part.mass;
                      total.center_x += part.mass * part.center_x;
                      total.center_y += part.mass * part.center_y;
                      total.inertia += part.inertia + part.mass * (part.center_x * part.center_x + part.center_y * part.center_y);
                  });
    if (total.mass > 0)
    {
        total.center_x /= total.mass;
        total.center_y /= total.mass;
        total.inertia -= total.mass * (total.center_x * total.center_x + total.center_y * total.center_y);
    }
    return total;
}

} // namespace

void move_center(SceneState& state, int body, Vec2 local_center)
{
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    if (local_center == sim.local_center)
        return;
    for_each_contact(state, body,
                     [&](int contact)
                     {
                         settle_manifold(state, contact);
                         leave_lane(state, contact);
                         state.contacts[contact].flags |= contact_flag::fresh;
                     });
    const Pose pose = sim.pose();
    const Position center = transform(pose, local_center);
    const Vec2 shift = center - sim.center;
    sim.velocity += cross(sim.angular_velocity, shift);
    sim.previous_center += shift;
    state.quiet_starts[static_cast<std::size_t>(body)].center += shift;
    sim.center = center;
    sim.local_center = local_center;
    state.graph_dirty = true; // lanes of hinges hold anchors relative to it
}

void update_inverse_mass(SceneState& state, int body)
{
    BodyRecord& record = state.bodies[body];
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    const bool dynamic = record.type == BodyType::Dynamic;
    const float inverse = dynamic && sim.mass > 0 ? 1 / sim.mass : 0;
    const Vec2 inverse_mass = {record.locks.linear_x ? 0 : inverse, record.locks.linear_y ? 0 : inverse};
    const float inverse_inertia = dynamic && sim.inertia > 0 && !record.locks.angular ? 1 / sim.inertia : 0;
    record.has_finite_mass = inverse_mass != Vec2{} || inverse_inertia != 0;
    if (sim.inverse_mass == inverse_mass && sim.inverse_inertia == inverse_inertia)
        return;
    sim.inverse_mass = inverse_mass;
    sim.inverse_inertia = inverse_inertia;
    for_each_contact(state, body, [&](int contact) { leave_lane(state, contact); }); // a lane holds the inverse masses
    state.graph_dirty = true;                                                        // and so do lanes of hinges
}

void obey_locks(const BodyRecord& record, BodySim& sim)
{
    if (record.type != BodyType::Dynamic)
        return;
    sim.velocity = {record.locks.linear_x ? 0 : sim.velocity.x, record.locks.linear_y ? 0 : sim.velocity.y};
    sim.angular_velocity = record.locks.angular ? 0 : sim.angular_velocity;
}

namespace {

void measure(const LeafView& leaf, BodySim& sim)
{
    sim.extent = std::max(sim.extent, leaf_extent(leaf, sim.local_center));
    sim.size = std::min(sim.size, static_cast<float>(inner_radius(leaf)));
}

} // namespace

void update_mass(SceneState& state, int body)
{
    const BodyRecord& record = state.bodies[body];
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    if (record.type != BodyType::Dynamic)
    {
        // Static and kinematic bodies turn about the origin of their frame.
        sim.mass = 0;
        sim.inertia = 0;
        move_center(state, body, {});
    }
    else if (!record.mass_overridden)
    {
        const LeafMass total = total_mass(state, body);
        // A dynamic body without mass weighs 1 kg and does not turn, so that it can be moved before it gets its shapes.
        sim.mass = total.mass > 0 ? static_cast<float>(total.mass) : 1;
        sim.inertia = static_cast<float>(total.inertia);
        move_center(state, body, {static_cast<float>(total.center_x), static_cast<float>(total.center_y)});
    }
    update_inverse_mass(state, body);
    obey_locks(record, sim); // a center that moves takes up the rotation of its body
    sim.extent = 0;
    sim.size = 1e30f;
    for_each_leaf(state, body, [&](int shape) { measure(leaf_view(state, shape), sim); });
}

void include_mass(SceneState& state, int body, int shape)
{
    if (state.bodies[body].type == BodyType::Dynamic)
    {
        update_mass(state, body);
        return;
    }
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    const auto include = [&](int leaf) { measure(leaf_view(state, leaf), sim); };
    if (state.shapes[shape].has_leaf)
        include(shape);
    for (int piece = state.shapes[shape].has_leaf ? none : state.shapes[shape].next_piece; piece != none;
         piece = state.shapes[piece].next_piece)
        include(piece);
}

FloatBox fat_box(const SceneData& scene, int shape)
{
    const SceneState& state = scene.state;
    const ShapeRecord& record = state.shapes[shape];
    const BodySim& sim = state.sims[static_cast<std::size_t>(record.body)];
    const FloatBox tight = box_of(outer_bounds(leaf_view(state, shape), sim.pose()));
    return state.bodies[record.body].type == BodyType::Static ? tight : grow(tight, scene.tolerances.box_margin);
}

void add_to_broad_phase(SceneData& scene, int shape)
{
    SceneState& state = scene.state;
    const ShapeRecord& record = state.shapes[shape];
    const Layer layer = state.bodies[record.body].awake_index != none ? Layer::Moving : Layer::Resting;
    state.broad_phase.insert(shape, fat_box(scene, shape), layer, {record.trigger, !traits_of(record.leaf).is_bounded},
                             filter_bits(record.filter));
    look_again(state, shape);
}

void refresh_boxes(SceneData& scene, int body)
{
    SceneState& state = scene.state;
    for_each_leaf(state, body,
                  [&](int shape)
                  {
                      if (!state.broad_phase.has(shape))
                          return;
                      state.broad_phase.set_box(shape, fat_box(scene, shape));
                      look_again(state, shape);
                  });
}

} // namespace carom::internal
