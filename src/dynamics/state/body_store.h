#pragma once

// Bodies and their shapes: mass, boxes, and iteration over a body's leaves.

#include "dynamics/state/scene_data.h"

namespace carom::internal {

/// Calls visit(shape slot) for every leaf of the body: its shapes, and the pieces of its chains. The next slot is read before the visit. A
/// piece is followed by the next piece, and the last one by the shape after its chain.
template <class Visit>
void for_each_leaf(const SceneState& state, int body, Visit&& visit)
{
    for (int shape = state.bodies[body].first_shape; shape != none;)
    {
        const ShapeRecord& record = state.shapes[shape];
        const int next = record.next_piece != none ? record.next_piece : state.shapes[record.owner].next_shape;
        if (record.has_leaf)
            visit(shape);
        shape = next;
    }
}

/// Calls visit(joint slot) for every joint of the body.
template <class Visit>
void for_each_joint(const SceneState& state, int body, Visit&& visit)
{
    for (int edge = state.bodies[body].first_joint; edge != none; edge = state.joints[edge >> 1].next[edge & 1])
        visit(edge >> 1);
}

[[nodiscard]] inline LeafView leaf_view(const SceneState& state, int shape)
{
    return view(state.shapes[shape].leaf, state.leaf_store);
}

/// Updates mass, center and inertia from the shapes (unless overridden), inverse masses from type and locks, and the extent.
/// The velocity of the center follows when the center moves.
void update_mass(SceneState& state, int body);

/// The same after one shape was added: a static body with a million shapes does not visit all of them again.
void include_mass(SceneState& state, int body, int shape);

/// Moves the center of mass: the velocity of the material is kept, and cached manifolds are computed anew.
void move_center(SceneState& state, int body, Vec2 local_center);

/// Clears the velocities that the locks forbid; a kinematic body has no locks.
void obey_locks(const BodyRecord& record, BodySim& sim);

/// Updates the inverse masses alone, after a change of type or locks.
void update_inverse_mass(SceneState& state, int body);

/// The shape searches for all its pairs in the next step.
inline void look_again(SceneState& state, int shape)
{
    append(state.fresh_shapes, shape);
    if (state.broad_phase.has(shape))
        state.broad_phase.renew(shape);
}

/// The fat box of a leaf at its body's current pose.
[[nodiscard]] FloatBox fat_box(const SceneData& scene, int shape);

/// Puts the leaf into the broad phase.
void add_to_broad_phase(SceneData& scene, int shape);

/// After a teleport or a change of geometry: computes new boxes, and lets the shapes search for pairs.
void refresh_boxes(SceneData& scene, int body);

} // namespace carom::internal
