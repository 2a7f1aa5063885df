#pragma once

// Bodies that take part in a step, and joints between them.

#include "dynamics/solver/contact/coloring.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Gives bodies that are awake their places as in Link, and says in Scratch::graph.flight who may fly as far as single bodies tell; no contact loads them
/// yet. Called again after more have woken, for these.
void forget_bodies(StepContext& ctx);
void place_bodies(StepContext& ctx);

/// When links of contacts are known: whom one loads does not fly.
void list_fliers(StepContext& ctx);

/// Fills Scratch::graph.joint_edges.
void gather_joints(StepContext& ctx);

/// Of a body with joints: the hinge to the world that it turns on, which nothing drives, or earthbound.
[[nodiscard]] std::int32_t flight_about_hinge(const SceneState& state, int body);

/// How a body may fly: none, freely; or the hinge to the world that it turns on. Else earthbound.
[[nodiscard]] inline std::int32_t flight_of(const SceneState& state, int body)
{
    const BodyRecord& record = state.bodies[body];
    if (record.first_joint != none)
        return flight_about_hinge(state, body);
    return record.has_finite_mass ? none : solver_owned;
}

/// Of a body, as in Link.
[[nodiscard]] inline std::int32_t place_of(const Scratch& scratch, int body)
{
    return scratch.graph.places[static_cast<std::size_t>(body)];
}

/// The contact gets no row in this step.
inline void leave_constraint(SceneState& state, std::int32_t contact)
{
    forget_impulses(state, contact);
    leave_color(state, state.contacts[contact]);
}

} // namespace carom::internal
