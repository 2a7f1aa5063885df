#include "dynamics/quarantine.h"

#include "dynamics/body_store.h"
#include "dynamics/contact_store.h"
#include "dynamics/wake.h"

namespace carom::internal {

void quarantine(StepContext& ctx, int body, float time)
{
    SceneState& state = ctx.state;
    BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    sim.velocity = {};
    sim.angular_velocity = 0;
    sim.force = {};
    sim.torque = 0;
    for_each_contact(state, body, [&](int contact) { destroy_contact(ctx.scene, contact, ctx.scene.events, time); });
    leave_awake(ctx.scene, body);
    state.bodies[body].enabled = false;
    for_each_leaf(state, body, [&](int shape) { state.broad_phase.remove(shape); });
    ctx.report.quarantined.push_back(body_id(state, body));
    ctx.report.flags |= static_cast<std::uint32_t>(StepFlag::BodyQuarantined);
}

} // namespace carom::internal
