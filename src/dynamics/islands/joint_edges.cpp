// Bodies and joints that take part in a step: awake bodies, joint edges between them, and the bodies that may fly as far as single bodies and their contacts
// show. Contact edges are found while contacts are updated (contact_edges.cpp). The rest of the islands stage works on these.

#include "dynamics/islands/joint_edges.h"

#include "core/grow.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/islands/layout/cached_graph.h"
#include "dynamics/solver/contact/prepare_wide.h"
#include "dynamics/solver/joint/joint_bodies.h"
#include "dynamics/solver/joint/joint_solver.h"
#include "dynamics/state/body_store.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

constexpr float limit_rounding = 1e-4f; // rad: flight stops a body this close to its limit

// Flight preserves the state of a hinge: its two anchors must coincide, and its angle must be within its limits.
bool is_closed(const StepContext& ctx, int index, int body)
{
    const JointRecord& joint = ctx.state.joints[index];
    if (joint.enable_limit)
    {
        const float angle = hinge_angle(ctx.state, joint);
        if (angle < joint.lower - limit_rounding || angle > joint.upper + limit_rounding)
            return false;
    }
    const auto world = [&](int b, Vec2 anchor)
    { return b == none ? Position(anchor) : transform(ctx.state.sims[static_cast<std::size_t>(b)].pose(), anchor); };
    const Vec2 gap = world(joint.body_b, joint.anchor_b) - world(joint.body_a, joint.anchor_a);
    return body != none && length(gap) <= 0.1f * ctx.scene.tolerances.slop;
}

class EdgeGathering
{
public:
    explicit EdgeGathering(StepContext& context) : ctx(context), state(context.state), scratch(context.scratch) {}

    void forget_bodies()
    {
        scratch.graph.flight_mode.clear();
        scratch.graph.could_fly.clear();
        scratch.graph.is_loaded.clear();
        scratch.graph.may_bounce.clear();
        scratch.graph.has_uneven = scratch.graph.has_kinematic = scratch.graph.has_hinged_fliers = false;
        // Only bodies that were awake in the last step: a body that never moves costs nothing.
        for (const std::int32_t body : scratch.graph.placed)
            scratch.graph.places[static_cast<std::size_t>(body)] = none;
        scratch.graph.places.resize(std::max(scratch.graph.places.size(), static_cast<std::size_t>(state.bodies.capacity())),
                                    none);
        scratch.graph.placed.clear();
    }

    // Bodies that have woken since the last call.
    void place_bodies()
    {
        const std::size_t first = scratch.graph.placed.size();
        const std::size_t count = state.awake_bodies.size();
        scratch.graph.placed.insert(scratch.graph.placed.end(), state.awake_bodies.begin() + static_cast<std::ptrdiff_t>(first),
                                    state.awake_bodies.end());
        scratch.graph.flight_mode.resize(count, solver_owned);
        scratch.graph.could_fly.resize(count, solver_owned);
        scratch.graph.may_bounce.resize(count);
        scratch.graph.is_loaded.resize(first); // without the dummy element
        scratch.graph.is_loaded.resize(count + 1);
        for_each_in_chunks(ctx.scene.def.tasks, count - first, bodies_per_task,
                           [&](std::size_t k)
                           {
                               const std::size_t i = first + k;
                               prefetch_hinge_of(i + prefetch_distance);
                               const int body = state.awake_bodies[i];
                               note_place(body, static_cast<std::int32_t>(i));
                               note_uneven(body);
                               if (ctx.scene.def.continuous)
                                   scratch.graph.flight_mode[i] = mode_of(body);
                           });
    }

    // A body that a contact loads does not fly. Branch-free: the branch would be mispredicted.
    void list_fliers()
    {
        set_size(scratch.graph.flying, scratch.graph.flight_mode.size());
        std::size_t count = 0;
        for (std::size_t i = 0; i < scratch.graph.flight_mode.size(); ++i)
        {
            const bool loaded = scratch.graph.is_loaded[i] != 0;
            const std::int32_t flight = scratch.graph.flight_mode[i];
            scratch.graph.could_fly[i] = loaded ? flight : scratch.graph.could_fly[i];
            scratch.graph.flight_mode[i] = loaded ? solver_owned : flight;
            scratch.graph.flying[count] = static_cast<std::int32_t>(i);
            count += scratch.graph.flight_mode[i] != solver_owned ? 1 : 0;
        }
        scratch.graph.flying.resize(count);
    }

    // A step changes nothing that joint edges depend on, except whether a body may fly.
    void gather_joints()
    {
        CachedGraph& cached = scratch.cached_graph;
        cached.is_current = cached.is_valid && !state.graph_dirty && bodies_are_unchanged(ctx);
        cached.joints_are_unchanged = cached.is_current && !scratch.graph.has_hinged_fliers && !cached.had_hinged_fliers;
        cached.had_hinged_fliers = scratch.graph.has_hinged_fliers;
        if (cached.joints_are_unchanged)
            return;
        scratch.graph.joint_edges.swap(cached.joints);
        using Some = std::vector<JointEdge>;
        const auto joints = static_cast<std::size_t>(state.joints.capacity());
        const std::span<Some> parts =
            find_in_chunks(ctx.scene.def.tasks, joints, part_of(joints, joints_per_task), scratch.graph.joints_of_task,
                           [&](std::size_t first, std::size_t last, Some& some)
                           {
                               some.clear();
                               for (auto j = static_cast<int>(first); j < static_cast<int>(last); ++j)
                               {
                                   if (state.joints.is_live(j))
                                       gather_joint(j, some);
                               }
                           });
        if (parts.size() == 1)
        {
            scratch.graph.joint_edges.swap(parts[0]);
            return;
        }
        scratch.graph.joint_edges.clear();
        for (const Some& some : parts)
            append_all(scratch.graph.joint_edges, some);
    }

private:
    // A body that may turn about the world has a single joint.
    [[gnu::always_inline]] void prefetch_hinge_of(std::size_t place) const
    {
        if (place >= state.awake_bodies.size())
            return;
        const BodyRecord& record = state.bodies[state.awake_bodies[place]];
        if (record.joint_count == 1)
            prefetch(state.joints[record.first_joint >> 1]);
    }

    void note_place(int body, std::int32_t place) const
    {
        const bool dynamic = state.bodies[body].type == BodyType::Dynamic;
        scratch.graph.places[static_cast<std::size_t>(body)] = dynamic ? place : -2 - place;
        if (!dynamic)
            std::atomic_ref(scratch.graph.has_kinematic).store(true, std::memory_order_relaxed);
    }

    void note_uneven(int body) const
    {
        const MotionLocks locks = state.bodies[body].locks;
        if (locks.linear_x != locks.linear_y)
            std::atomic_ref(scratch.graph.has_uneven).store(true, std::memory_order_relaxed);
    }

    [[nodiscard]] std::int32_t mode_of(int body) const
    {
        if (state.bodies[body].type != BodyType::Dynamic)
            return solver_owned;
        const std::int32_t mode = flight_mode_of(state, body);
        if (mode == solver_owned || mode == free_flight)
            return mode;
        if (!is_closed(ctx, mode, body))
            return solver_owned;
        std::atomic_ref(scratch.graph.has_hinged_fliers).store(true, std::memory_order_relaxed);
        return mode;
    }

    // With a single thread, one task finds all joints.
    [[nodiscard]] std::size_t part_of(std::size_t count, std::size_t per_task) const
    {
        return ctx.scene.def.tasks.worker_count > 1 ? per_task : std::max(count, per_task);
    }

    void gather_joint(int index, std::vector<JointEdge>& edges) const
    {
        const JointRecord& joint = state.joints[index];
        const auto place = [&](int body) { return body == none ? none : place_of(scratch, body); };
        const auto takes_part = [&](int body, std::int32_t at)
        { return at != none || body == none || state.bodies[body].enabled; };
        const std::int32_t a = place(joint.body_a);
        const std::int32_t b = place(joint.body_b);
        if ((a < 0 && b < 0) || !takes_part(joint.body_a, a) || !takes_part(joint.body_b, b))
            return;
        JointEdge& edge = edges.emplace_back();
        edge.joint = index;
        edge.a = a;
        edge.b = b;
        edge.hinge = fits_joint_lane(joint);
        edge.holds = joint.only_holds;
        edge.damped = joint.loses_energy;
        edge.binds = !edge.holds && joint.kind != JointType::Spring;
        edge.flies = may_fly(a) || may_fly(b);
    }

    // True if a jointed body may fly about a hinge to the world.
    [[nodiscard]] bool may_fly(std::int32_t place) const
    {
        return place >= 0 && (scratch.graph.flight_mode[static_cast<std::size_t>(place)] != solver_owned ||
                              scratch.graph.could_fly[static_cast<std::size_t>(place)] != solver_owned);
    }

    StepContext& ctx;
    SceneState& state;
    Scratch& scratch;
};

} // namespace

std::int32_t flight_about_hinge(const SceneState& state, int body)
{
    const BodyRecord& record = state.bodies[body];
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    const int edge = record.first_joint;
    if (record.joint_count != 1)
        return solver_owned;
    const JointRecord& joint = state.joints[edge >> 1];
    const int other = joint.body_a == body ? joint.body_b : joint.body_a;
    const bool hinged = joint.kind == JointType::Revolute && !joint.enable_motor && joint.hertz == 0 &&
                        (other == none || state.bodies[other].type == BodyType::Static) && sim.inverse_inertia > 0;
    if (!hinged)
        return solver_owned;
    // A body locked along an axis is held twice: it turns only if the pivot is its center of mass.
    const Vec2 anchor = joint.body_a == body ? joint.anchor_a : joint.anchor_b;
    const bool centered = anchor == sim.local_center;
    return centered || (sim.inverse_mass.x > 0 && sim.inverse_mass.y > 0) ? edge >> 1 : solver_owned;
}

void forget_bodies(StepContext& ctx) { EdgeGathering(ctx).forget_bodies(); }

void place_bodies(StepContext& ctx) { EdgeGathering(ctx).place_bodies(); }

void list_fliers(StepContext& ctx) { EdgeGathering(ctx).list_fliers(); }

void gather_joints(StepContext& ctx) { EdgeGathering(ctx).gather_joints(); }

} // namespace carom::internal
