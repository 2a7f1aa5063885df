// One step, in seven stages: the boxes that cover all paths of this step (sweep), pairs of boxes that meet (pairs), manifolds of near pairs
// (contacts), and the sets of bodies that must be solved together (islands). Islands are solved through all sub-steps, with bodies in flight
// at their own times between the sub-steps of all others (solve). Only then are poses written back and quiet islands put to sleep (commit),
// and events sorted for the user (events). In the middle of a step only force laws, mix functions and the task hooks are called.

#include "core/clock.h"
#include "dynamics/forces/fields.h"
#include "dynamics/stages.h"
#include "dynamics/uneven_steps.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

constexpr float longest_step = 1.0f / 30; // s

// The frequency of contacts is at most 0.15 sqrt(passes) / (longest recent sub-step), twice that against bodies of infinite mass. If it followed the present sub-step,
// steps of changing length would change the stiffness, and stacks would rise and sink.
// A load travels by one contact in a pass. On the way it swings, and dies down as long as a contact gives way to it faster than overlap is pushed out: at
// 1 / (h^2 w (2 z + h w)) against w / (2 z + h w), so while h w < 1, or < sqrt(passes). A pyramid of a hundred layers, solved in one pass, after 4 to 8 s:
//   3/16   it moves at 28 mm/s in the mean, and its boxes have strayed by 16 cm
//   0.15   4 mm/s, 25 cm
//   1/8    35 cm
// A speed that gravity gives in two sub-steps is no impact. Joints: see joint_solver.cpp.
void set_softness(StepContext& ctx, int passes)
{
    const SceneDef& def = ctx.scene.def;
    const float root =
        std::sqrt(static_cast<float>(passes)); // of the damping as well: overlap is pushed out as fast as with one pass
    const float hertz = root * std::min(def.contact_hertz, 0.15f / ctx.state.longest_substep);
    const float damping = root * def.contact_damping_ratio;
    ctx.contact_softness = make_softness(hertz, damping, ctx.h);
    ctx.static_softness = make_softness(2 * hertz, damping, ctx.h);
    ctx.joint_hertz = 0.25f / ctx.h;
    ctx.rest_speed = 2 * ctx.h * length(ctx.state.gravity) + ctx.scene.tolerances.rest_speed;
}

// A step longer than 1/30 s has the sub-steps of as many steps as are needed to cover it.
int substeps_of(const SceneDef& def, float dt)
{
    const float steps = std::ceil(dt / longest_step - 0.001f);
    return def.substeps * std::max(static_cast<int>(steps), 1);
}

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

    const int substeps = substeps_of(scene.def, dt);
    StepContext ctx{scene, scene.state, scene.scratch, report, dt, dt / static_cast<float>(substeps), substeps};
    begin_substeps(ctx);
    set_softness(ctx, 1);
    report.substeps = substeps;
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

// The step as an island sees it that subdivides its sub-steps or goes over its contacts more than once.
StepContext step_of(const StepContext& ctx, const Island& island)
{
    StepContext s = ctx;
    if (island.policy.subdivisions <= 1 && island.policy.passes <= 1)
        return s;
    s.subdivisions = island.policy.subdivisions;
    s.substeps = ctx.substeps * s.subdivisions;
    s.h = ctx.dt / static_cast<float>(s.substeps);
    set_softness(s, island.policy.passes);
    return s;
}

const StepReport& step(SceneData& scene, float dt)
{
    StageTimes ms;
    Stopwatch watch;
    StepContext ctx = begin_step(scene, dt); // clears events; derives h and softness
    watch.time(ms.sweep, [&] { sweep_paths(ctx); });
    watch.time(ms.pairs, [&] { find_pairs(ctx); });
    watch.time(ms.contacts, [&] { update_contacts(ctx); });
    watch.time(ms.islands, [&] { build_islands(ctx); });
    save_impulses(ctx); // if this step is shorter than recent ones: they are averaged with the new ones below, see uneven_steps.h
    watch.time(ms.solve, [&] { solve_islands(ctx); });
    watch.time(ms.commit, [&] { commit(ctx); });
    average_saved_impulses(ctx);
    watch.time(ms.events, [&] { publish_events(ctx); });
    end_step(ctx);
    reorder(ctx);
    ms.total = watch.total();
    scene.report.ms = ms;
    return scene.report;
}

} // namespace carom::internal
