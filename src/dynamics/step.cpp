// One step, in seven stages. First where everything may go in this step (sweep) and which boxes may meet on the way (pairs); then how near pairs
// touch (contacts), and who must be solved together because of it (units). The units are solved through all sub-steps, balls in flight
// at their own times between the sub-steps of everything else (solve). Only then are poses written back and quiet islands put to sleep (commit), and the
// user hears what happened (events): nothing calls the user in the middle of a step.

#include "core/clock.h"
#include "dynamics/fields.h"
#include "dynamics/stages.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

StepContext begin_step(SceneData& scene, float dt)
{
    scene.events.clear();
    StepReport& report = scene.report;
    std::vector<BodyId> quarantined = std::move(report.quarantined);
    std::vector<SubstepPose> poses = std::move(report.substep_poses);
    quarantined.clear();
    poses.clear();
    report = {};
    report.quarantined = std::move(quarantined);
    report.substep_poses = std::move(poses);

    const SceneDef& def = scene.def;
    const float h = dt / static_cast<float>(def.substeps);
    // 3/16 of the sub-step rate: at 1/4 a pyramid of twenty rows creeps apart by 16 cm, at 3/16 by 4 cm (and softer ones sag).
    const float hertz = std::min(def.contact_hertz, 0.1875f / h);
    StepContext ctx{scene,
                    scene.state,
                    scene.scratch,
                    report,
                    dt,
                    h,
                    def.substeps,
                    make_softness(hertz, def.contact_damping_ratio, h),
                    make_softness(2 * hertz, def.contact_damping_ratio, h),
                    0.25f / h,
                    0};
    ctx.rest_speed = 2 * h * length(scene.state.gravity) + scene.tolerances.rest_speed;
    report.substeps = def.substeps;
    apply_fields(ctx);
    return ctx;
}

void end_step(StepContext& ctx)
{
    StepReport& report = ctx.report;
    SceneState& state = ctx.state;
    state.time += static_cast<double>(ctx.dt);
    ++state.step_count;
    report.bodies = state.bodies.count();
    report.awake_bodies = static_cast<int>(state.awake_bodies.size());
    report.shapes = state.shapes.count();
    report.joints = state.joints.count();
}

} // namespace

const StepReport& step(SceneData& scene, float dt)
{
    StageTimes ms;
    timed(ms.total,
          [&]
          {
              StepContext ctx = begin_step(scene, dt); // clears events; derives h and softness once
              timed(ms.sweep, [&] { sweep_paths(ctx); });
              timed(ms.pairs, [&] { find_pairs(ctx); });
              timed(ms.contacts, [&] { update_contacts(ctx); });
              timed(ms.units, [&] { build_units(ctx); });
              timed(ms.solve, [&] { solve_units(ctx); });
              timed(ms.commit, [&] { commit_and_sleep(ctx); });
              timed(ms.events, [&] { publish_events(ctx); });
              end_step(ctx);
          });
    scene.report.ms = ms;
    return scene.report;
}

} // namespace carom::internal
