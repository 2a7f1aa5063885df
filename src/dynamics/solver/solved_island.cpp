// Puts together the data that the parts of an island's solver share.

#include "dynamics/solver/solved_island.h"

#include "core/index.h"
#include "core/trigonometry.h"
#include "dynamics/state/scene_data.h"

namespace carom::internal {

SolvedIsland::SolvedIsland(const StepContext& step, const Island& solved, IslandOutput& out, WorkerTeam& workers)
    : ctx(step_of(step, solved)), scratch(step.scratch), island(solved), output(out), team(workers),
      view{step.scratch.solver.states.data(), step.scratch.solver.constants.data(), ctx.h, 1 / ctx.h,
           step.scene.tolerances.push_speed},
      constraints(constraints_of(step.scratch, solved)),
      joints(std::span(step.scratch.solver.joints).subspan(as_index(solved.first_joint), as_index(solved.joint_count)))
{}

bool SolvedIsland::has_fliers() const
{
    return std::ranges::any_of(fliers_of(scratch, island), [](const Flier& f) { return !f.landed; });
}

BodyPose SolvedIsland::pose_of(int body, std::int32_t state, float ahead) const
{
    const BodySim& sim = ctx.state.sims[as_index(body)];
    const BodyState& s = view.states[state];
    Rotation q = s.delta_rotation;
    if (ahead != 0 && s.angular_velocity != 0)
        q = Rotation::from_angle(ahead * s.angular_velocity) * q;
    return {sim.center + s.delta_position + ahead * s.velocity, q * sim.rotation, sim.local_center};
}

} // namespace carom::internal
