#pragma once

// Links of contacts and joints between the bodies that take part in a step.

#include "dynamics/contact_colors.h"
#include "dynamics/contact_store.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Fills Scratch::links and joint_links, and flight as far as it is known from single bodies and their contacts.
void gather_links(StepContext& ctx);

/// Of a body with joints: the hinge to the world that it turns on, which nothing drives, or earthbound.
[[nodiscard]] std::int32_t flight_about_hinge(const SceneState& state, int body);

/// How a body may fly: none, freely; or the hinge to the world that it turns on. Else earthbound.
[[nodiscard]] inline std::int32_t flight_of(const SceneState& state, int body)
{
    const BodyRecord& record = state.bodies[body];
    if (record.first_joint != none)
        return flight_about_hinge(state, body);
    return record.gives_way ? none : earthbound;
}

/// Of a body, as in Link.
[[nodiscard]] inline std::int32_t place_of(const Scratch& scratch, int body)
{
    return scratch.places[static_cast<std::size_t>(body)];
}

/// The contact gets no row in this step.
inline void leave_row(SceneState& state, std::int32_t contact)
{
    forget_impulses(state, contact);
    leave_color(state, state.contacts[contact]);
}

} // namespace carom::internal
