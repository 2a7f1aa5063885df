// Stage 6, commit: writes the result of the step back into the records, in the order of the islands; then deferred impulses and triggers;
// then bodies come to rest or fall asleep (sleep.cpp).

#include "core/grow.h"
#include "core/refuse.h"
#include "core/task_pool.h"
#include "core/trigonometry.h"
#include "dynamics/continuous/motion.h"
#include "dynamics/continuous/safety_sweep.h"
#include "dynamics/forces/force_laws.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/narrowphase/touch_tracker.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/solver/island_constraints.h"
#include "dynamics/stages.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/quarantine.h"
#include "dynamics/state/turns.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

Rotation renormalized(Rotation q)
{
    const float l = std::sqrt(q.c * q.c + q.s * q.s);
    return l > 0 ? Rotation{q.c / l, q.s / l} : Rotation{};
}

// --- poses ---------------------------------------------------------------------------------------------------------------------------

// The path of a kinematic body is a function of time alone.
void record_kinematic(StepContext& ctx, int body)
{
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    for (int k = 1; k <= ctx.substeps; ++k)
    {
        const float t = ctx.h * static_cast<float>(k);
        BodySim then = sim;
        then.center += t * sim.velocity;
        then.rotation = Rotation::from_angle(t * sim.angular_velocity) * sim.rotation;
        ctx.report.substep_poses.push_back({body_id(ctx.state, body), t, then.pose()});
    }
}

void commit_kinematic(const StepContext& ctx, int body)
{
    BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    sim.previous_center = sim.center;
    sim.previous_rotation = sim.rotation;
    if (ctx.state.bodies[body].has_target)
    {
        const BodyTarget& target = ctx.state.targets[static_cast<std::size_t>(body)];
        sim.center = target.center;
        sim.rotation = target.rotation;
        count_turns(ctx.state.turns[static_cast<std::size_t>(body)], sim.previous_rotation, sim.rotation);
        return;
    }
    sim.center += ctx.dt * sim.velocity;
    if (sim.angular_velocity != 0)
    {
        const float displacement = ctx.dt * sim.angular_velocity;
        sim.rotation = renormalized(Rotation::from_angle(displacement) * sim.rotation);
        count_turns(ctx.state.turns[static_cast<std::size_t>(body)], sim.previous_rotation, sim.rotation,
                    static_cast<double>(displacement));
    }
}

void commit_kinematic_bodies(StepContext& ctx)
{
    for (const std::int32_t body : ctx.state.awake_bodies)
    {
        if (ctx.state.bodies[body].type != BodyType::Kinematic)
            continue;
        if (ctx.scene.def.record_substeps)
            record_kinematic(ctx, body);
        commit_kinematic(ctx, body);
    }
}

bool is_sound(const BodyState& s, double x, double y)
{
    return is_finite(s.velocity) && is_finite(s.angular_velocity) && is_finite(x) && is_finite(y) &&
           is_finite(s.delta_rotation.c) && is_finite(s.delta_rotation.s);
}

// The solver's contacts cover the paths on which bodies set out. A body that was struck or pulled off its path and moves farther than its own
// size may have ended anywhere; a body that is pressed into a wall creeps into it.
bool may_have_passed(const StepContext& ctx, const BodyState& s, int body)
{
    if (!ctx.scene.def.continuous || (s.flags & (body_flag::flier | body_flag::free_fall)) != 0)
        return false;
    if ((s.flags & body_flag::pressed) != 0)
        return true;
    const BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    if (dot(s.delta_position, s.delta_position) <= sim.size * sim.size)
        return false;
    const Vec2 strayed = s.delta_position - predicted_shift(ctx, ctx.state.bodies[body], sim);
    const float seen = 0.5f * ctx.scene.tolerances.box_margin; // a body that rests nearer to the predicted path has a contact
    return dot(strayed, strayed) > seen * seen || ctx.state.bodies[body].first_contact != none;
}

// A body stopped at a wall has not covered the rest of its displacement: forces have done no work on it there.
float without_work(const StepContext& ctx, const BodyState& s, std::int32_t index, double dx, double dy)
{
    const Vec2 a = ctx.scratch.solver.constants[static_cast<std::size_t>(index)].acceleration;
    const double twice_work = 2 * (static_cast<double>(a.x) * dx + static_cast<double>(a.y) * dy);
    const auto square = static_cast<double>(dot(s.velocity, s.velocity));
    return twice_work > 0 && square > 0 ? static_cast<float>(std::sqrt(std::max(1 - twice_work / square, 0.0))) : 1;
}

// Writes to its own body only.
void commit_state(const StepContext& ctx, std::int32_t index)
{
    BodyState& s = ctx.scratch.solver.states[static_cast<std::size_t>(index)];
    const int body = ctx.scratch.solver.state_bodies[static_cast<std::size_t>(index)];
    if (body == none || (s.flags & body_flag::dynamic) == 0)
        return;
    BodySim& sim = ctx.state.sims[static_cast<std::size_t>(body)];
    double x = s.delta_position.x;
    double y = s.delta_position.y;
    bool needs_wall_check = false;
    if (const std::int32_t f = ctx.scratch.flight.flier_of_state[static_cast<std::size_t>(index)]; f != none)
    {
        const Flier& flier = ctx.scratch.flight.fliers[static_cast<std::size_t>(f)];
        needs_wall_check = flier.needs_wall_check;
        const CenterMotion center = center_of(flier); // the path itself, in double
        x = flier.landed ? x : center.x;
        y = flier.landed ? y : center.y;
    }
    if ((s.flags & body_flag::unsound) != 0 || !is_sound(s, x, y))
    {
        s.flags |= body_flag::unsound;
        begin_at_start(ctx.state, body, s);
        return;
    }
    const Position displacement{x, y};
    const Position free = needs_wall_check || may_have_passed(ctx, s, body)
                              ? free_displacement(ctx, body, displacement, s.delta_rotation * sim.rotation)
                              : displacement;
    if (free != displacement)
    {
        s.flags |= body_flag::stopped;
        s.velocity *= without_work(ctx, s, index, x - free.x, y - free.y);
        x = free.x;
        y = free.y;
    }
    sim.center.x += x;
    sim.center.y += y;
    if (s.delta_rotation != Rotation{})
    {
        const Rotation reference = sim.rotation;
        sim.rotation = renormalized(s.delta_rotation * reference);
        count_turns(ctx.state.turns[static_cast<std::size_t>(body)], reference, sim.rotation, s);
    }
    sim.velocity = s.velocity;
    sim.angular_velocity = s.angular_velocity;
}

// --- contacts and joints ---------------------------------------------------------------------------------------------------------------

// Reaction of a flier's hinge while it was in flight; forces are given as on body b.
void commit_hinge(StepContext& ctx, const Flier& flier)
{
    if (flier.joint == none)
        return;
    JointRecord& joint = ctx.state.joints[flier.joint];
    const float per_time = static_cast<float>(joint.body_b == flier.body ? 1 : -1) / ctx.dt;
    joint.force += per_time * flier.reaction;
    joint.torque += per_time * flier.limit_reaction;
}

// A wall that stops a body opens its joints, so the errors recorded for them no longer hold.
void forget_errors_of_stopped(StepContext& ctx)
{
    const auto is_stopped = [&](std::int32_t state)
    { return (ctx.scratch.solver.states[static_cast<std::size_t>(state)].flags & body_flag::stopped) != 0; };
    for (const JointWork& work : ctx.scratch.solver.joints)
        ctx.state.joints[work.joint].knows_errors = !is_stopped(work.a) && !is_stopped(work.b);
}

// --- results of flight that are applied in order -----------------------------------------------------------------------------------------

void apply_deferred(StepContext& ctx, const DeferredImpulse& d)
{
    if (!ctx.state.bodies[d.body].has_finite_mass)
        return;
    wake_body(ctx.scene, d.body);
    BodySim& sim = ctx.state.sims[static_cast<std::size_t>(d.body)];
    sim.velocity.x += sim.inverse_mass.x * d.impulse.x;
    sim.velocity.y += sim.inverse_mass.y * d.impulse.y;
    sim.angular_velocity += sim.inverse_inertia * cross(d.arm, d.impulse);
}

void merge_output(StepContext& ctx, const IslandOutput& output)
{
    const SceneState& state = ctx.state;
    for (const ContactConstraint& constraint : output.late_constraints)
        commit_constraint(ctx.state, constraint);
    report_begins(ctx, output);
    for (const DeferredImpulse& d : output.deferred)
        apply_deferred(ctx, d);
    for (const std::int32_t shape : output.kicked_shapes)
    {
        RareTraits& traits = ctx.state.rare_traits[ctx.state.shapes[shape].rare_traits];
        traits.kick_ready = ctx.state.time + static_cast<double>(traits.kick.cooldown);
    }
    for (const RecordedPose& p : output.poses)
        ctx.report.substep_poses.push_back({body_id(state, p.body), p.time, p.pose});
    ctx.report.flight_impacts += output.flight_impacts;
    ctx.report.bulk_impacts += output.bulk_impacts;
    if (output.capped)
        ctx.report.flags |= static_cast<std::uint32_t>(StepFlag::ImpactsCapped);
    end_bounces(ctx, output);
}

// Bodies with more impacts than flight resolves at a bearable cost, for the next steps.
void note_rattling(StepContext& ctx)
{
    std::vector<RattlingBody>& list = ctx.state.rattling;
    for (RattlingBody& r : list)
        r.impacts /= 2;
    for (std::size_t u = 0; u < ctx.scratch.solver.islands.size(); ++u)
    {
        const Island& island = ctx.scratch.solver.islands[u];
        if (ctx.scratch.solver.outputs[u].flight_impacts == 0)
            continue;
        const int most = most_impacts_of_a_step(ctx.scratch.solver.outputs[u].flight_impacts, island.dynamic_count);
        for (const Flier& f : fliers_of(ctx.scratch, island))
        {
            const int impacts = f.impacts_before + f.impacts;
            const auto awake = static_cast<std::size_t>(ctx.state.bodies[f.body].awake_index);
            if (impacts > most && ctx.scratch.graph.may_bounce[awake] != 0)
                list.push_back({f.body, impacts / most});
        }
    }
    std::erase_if(list, [](const RattlingBody& r) { return r.impacts == 0; });
    std::ranges::sort(list, {}, [](const RattlingBody& r) { return std::pair(r.body, -r.impacts); });
    list.erase(std::ranges::unique(list, {}, &RattlingBody::body).begin(), list.end());
}

} // namespace

void commit(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    scratch.unsound.clear();
    if (scratch.graph.has_kinematic)
        commit_kinematic_bodies(ctx);
    forget_surroundings(ctx);
    std::atomic<bool> any_unsound{false};
    std::atomic<bool> any_stopped{false};
    for_each_in_chunks(ctx.scene.def.tasks, scratch.solver.state_of.size(), bodies_per_task,
                       [&](std::size_t place)
                       {
                           const std::int32_t i = scratch.solver.state_of[place];
                           if (i == none)
                               return;
                           commit_state(ctx, i);
                           const std::uint32_t flags = scratch.solver.states[static_cast<std::size_t>(i)].flags;
                           if ((flags & body_flag::unsound) != 0)
                               raise(any_unsound);
                           if ((flags & body_flag::stopped) != 0)
                               raise(any_stopped);
                       });
    for (std::size_t i = 0; any_unsound && i < scratch.solver.states.size(); ++i)
    {
        if ((scratch.solver.states[i].flags & body_flag::unsound) != 0)
            scratch.unsound.push_back(scratch.solver.state_bodies[i]);
    }
    if (any_stopped)
        forget_errors_of_stopped(ctx);
    note_rattling(ctx);
    for (const Flier& flier : scratch.flight.fliers)
        commit_hinge(ctx, flier);
    note_pending_impacts(ctx);
    for (std::size_t u = 0; u < scratch.solver.islands.size(); ++u)
    {
        append_all(ctx.scene.events.impacts, scratch.solver.outputs[u].impacts);
        merge_output(ctx, scratch.solver.outputs[u]);
    }
    update_triggers(ctx);
    for (const std::int32_t body : scratch.unsound)
        quarantine(ctx, body, ctx.dt);
    if (!scratch.unsound.empty())
        forget_events_of(ctx, scratch.unsound);
    settle_bodies(ctx);
}

} // namespace carom::internal
