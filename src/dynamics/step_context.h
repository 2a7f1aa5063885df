#pragma once

// Data that the stages of one step pass to each other. Each directory has a workspace of its own. Vectors are cleared, not freed: a settled
// scene steps without allocating.

#include "dynamics/broadphase/workspace.h"
#include "dynamics/continuous/workspace.h"
#include "dynamics/islands/layout/workspace.h"
#include "dynamics/islands/workspace.h"
#include "dynamics/memory/workspace.h"
#include "dynamics/narrowphase/workspace.h"
#include "dynamics/sensors/workspace.h"
#include "dynamics/sleep/workspace.h"
#include "dynamics/solver/softness.h"
#include "dynamics/solver/workspace.h"
#include "dynamics/state/scene_state.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

struct SceneData;

/// Impulses of the step before, see uneven_steps.cpp.
struct UnevenStepsWorkspace
{
    std::vector<ContactImpulses> impulses_before; ///< by contact slot
    std::vector<std::array<float, joint_slots>> joint_impulses_before;
};

/// Work memory of a scene, which a snapshot leaves out.
struct Scratch
{
    BroadPhaseWorkspace broad;
    NarrowPhaseWorkspace narrow;
    GraphWorkspace graph;
    MeetingsWorkspace meetings;
    LayoutWorkspace layout;
    CachedGraph cached_graph;
    CachedConstraints cached_constraints;
    Reuse reuse = Reuse::Nothing; ///< in this step
    SolverWorkspace solver;
    FlightWorkspace flight;
    SensorWorkspace sensors;
    SleepWorkspace sleep;
    ReorderWorkspace reordering;
    UnevenStepsWorkspace uneven;
    std::vector<std::int32_t> unsound; ///< bodies whose state is no longer finite
    std::vector<std::int32_t> order;   ///< scratch list for any function, valid until it returns

    Scratch();
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
};

/// Fliers of an island, in flight or landed.
[[nodiscard]] inline std::span<Flier> fliers_of(Scratch& scratch, const Island& island)
{
    return {scratch.flight.fliers.data() + island.first_flier, static_cast<std::size_t>(island.flier_count)};
}

/// Contact constraints of an island outside of lanes; those added since the step began are in IslandOutput::late_constraints.
[[nodiscard]] inline std::span<ContactConstraint> constraints_of(Scratch& scratch, const Island& island)
{
    return {scratch.solver.constraints.data() + island.first_constraint, static_cast<std::size_t>(island.constraint_count)};
}

/// Those of an island's blocks.
[[nodiscard]] inline BlowBits blow_bits(Scratch& scratch, const Island& island)
{
    return {scratch.solver.struck.data() + island.wide_store, scratch.solver.relieved.data() + island.wide_store};
}

struct StepContext
{
    SceneData& scene;
    SceneState& state;
    Scratch& scratch;
    StepReport& report;
    float dt; ///< of the step, s
    float h;  ///< of a sub-step, s
    int substeps;
    int subdivisions = 1; ///< per sub-step of the scene, in islands whose contacts turn fast
    Softness contact_softness{};
    Softness static_softness{}; ///< against bodies of infinite mass: twice the frequency
    float joint_hertz = 0;
    float rest_speed = 0; ///< slower approach is rest, not an impact: what gravity gives in two sub-steps
};

/// Approach speed of the weakest blow that may take back a load, m/s: what gravity gives in a sub-step, or a little more.
[[nodiscard]] inline float least_blow(const StepContext& ctx) { return 0.5f * ctx.rest_speed; }
/// Points that bear a load and are farther apart have been stopped in part, so that they meet within a sub-step, m.
[[nodiscard]] inline float halfway_gap(const StepContext& ctx) { return 0.5f * ctx.h * least_blow(ctx); }

/// The step as an island takes it: with sub-steps subdivided as its policy asks for.
[[nodiscard]] StepContext step_of(const StepContext& ctx, const Island& island);

/// Greatest displacement of any point of a body in this step, if nothing strikes it; 0 for a body that is not awake.
[[nodiscard]] inline float motion_of(const StepContext& ctx, int body)
{
    const int place = ctx.state.bodies[body].awake_index;
    return place == none ? 0 : ctx.scratch.broad.motion[static_cast<std::size_t>(place)];
}

/// Displacement of a body's center of mass over the step, if nothing stops it.
[[nodiscard]] inline Vec2 predicted_shift(const StepContext& ctx, const BodyRecord& record, const BodySim& sim)
{
    if (record.type != BodyType::Dynamic)
        return ctx.dt * sim.velocity;
    const Vec2 a = {sim.gravity_scale * ctx.state.gravity.x + sim.inverse_mass.x * sim.force.x,
                    sim.gravity_scale * ctx.state.gravity.y + sim.inverse_mass.y * sim.force.y};
    return ctx.dt * sim.velocity + ctx.dt * ctx.dt * a;
}

} // namespace carom::internal
