#pragma once

// Look-up of slots from public ids, refusing stale ones; shared by the files of the public API.

#include "core/refuse.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/scene_data.h"

#include <string>

namespace carom::internal {

template <class Kind>
[[nodiscard]] std::string to_text(Id<Kind> id)
{
    return id.is_null() ? std::string("null")
                        : "(slot " + std::to_string(id.slot - 1) + ", generation " + std::to_string(id.generation) + ")";
}

[[nodiscard]] inline bool is_live(const SceneState& s, BodyId id) { return s.bodies.is_live(slot_of(id), id.generation); }
[[nodiscard]] inline bool is_live(const SceneState& s, ShapeId id) { return s.shapes.is_live(slot_of(id), id.generation); }
[[nodiscard]] inline bool is_live(const SceneState& s, JointId id) { return s.joints.is_live(slot_of(id), id.generation); }

template <class Kind>
[[nodiscard]] bool check_live(const SceneData& data, const char* function, const char* field, Id<Kind> id)
{
    return is_live(data.state, id) || refuse(function, field, to_text(id), "must name something alive in this scene");
}

void destroy_joint(SceneData& data, int joint);
void destroy_shape(SceneData& data, int shape);
void unlink_shape(SceneData& data, int shape);

/// Removes the leaves of a public shape from the broad phase and the store, and its contacts.
void remove_leaves(SceneData& data, int shape);
/// Creates the leaves of a public shape from its geometry.
void add_leaves(SceneData& data, int shape, const Geometry& geometry);

} // namespace carom::internal
