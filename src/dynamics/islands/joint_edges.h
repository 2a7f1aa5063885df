#pragma once

// Bodies that take part in a step, and the joint edges between them.

#include "dynamics/state/coloring.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Give awake bodies their indices as in ContactEdge, and note in Scratch::graph.flight_mode which of them may fly as far as a single body shows. Contact loads are
/// not known yet. place_bodies is called again after more bodies have woken, for these.
void forget_bodies(StepContext& ctx);
void place_bodies(StepContext& ctx);

/// Called when contact edges are known: a body that a contact loads does not fly.
void list_fliers(StepContext& ctx);

/// Fills Scratch::graph.joint_edges.
void gather_joints(StepContext& ctx);

/// For a body with joints: the undriven hinge to the world about which it turns, or solver_owned.
[[nodiscard]] std::int32_t flight_about_hinge(const SceneState& state, int body);

/// How a body may fly: free_flight, or the hinge to the world about which it turns. Otherwise solver_owned.
[[nodiscard]] inline std::int32_t flight_mode_of(const SceneState& state, int body)
{
    const BodyRecord& record = state.bodies[body];
    if (record.first_joint != none)
        return flight_about_hinge(state, body);
    return record.has_finite_mass ? free_flight : solver_owned;
}

/// Index of a body as in ContactEdge.
[[nodiscard]] inline std::int32_t place_of(const Scratch& scratch, int body)
{
    return scratch.graph.places[static_cast<std::size_t>(body)];
}

/// The contact gets no constraint in this step.
inline void leave_constraint(SceneState& state, std::int32_t contact)
{
    forget_impulses(state, contact);
    leave_color(state, state.contacts[contact]);
}

} // namespace carom::internal
