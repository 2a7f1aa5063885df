// A solver-owned body that is struck hard in a step may move farther than its contacts cover. Its core, a circle of half the inscribed
// radius, is then swept along its displacement and stops at the first static shape. The velocity is kept, so that the next step, which sees
// the wall, resolves the bounce; the rest of this step's time is lost.

#include "dynamics/continuous/safety_sweep.h"

#include "collision/time_of_impact.h"
#include "dynamics/broadphase/half_space_box.h"
#include "dynamics/narrowphase/material.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "geometry/leaf_traits.h"
#include "geometry/surface.h"

#include <algorithm>
#include <atomic>

namespace carom::internal {

namespace {

constexpr int most_passes = 4;
constexpr double nearly_all = 0.999; // of a displacement

struct Core
{
    Vec2 center; ///< in the body's frame
    double radius;
};

Core core_of(const LeafView& v)
{
    const Leaf& leaf = *v.leaf;
    const double radius = 0.5 * inner_radius(v);
    if (leaf.type == LeafType::Circle)
        return {leaf.p0, radius};
    if (traits_of(leaf).has_two_ends)
        return {0.5f * (leaf.p0 + leaf.p1), radius};
    Vec2 sum{};
    for (int i = 0; i < leaf.count; ++i)
        sum += v.points[i];
    return {(1 / static_cast<float>(leaf.count)) * sum, radius};
}

FloatBox box_around(Position start, double radius, double dx, double dy)
{
    return round_outwards(start.x + std::min(dx, 0.0) - radius, start.y + std::min(dy, 0.0) - radius,
                          start.x + std::max(dx, 0.0) + radius, start.y + std::max(dy, 0.0) + radius);
}

// The part of a displacement that the core of a shape can move before it meets a wall.
double free_part(const StepContext& ctx, int shape, const Core& core, Position start, Position displacement)
{
    const SceneState& state = ctx.state;
    const FramePath path{{0, 0, displacement.x, displacement.y, 0, 0}};
    const Leaf disc = {.type = LeafType::Circle, .r0 = static_cast<float>(core.radius)};
    double part = 1;
    const auto visit = [&](int other)
    {
        const ShapeRecord& wall = state.shapes[other];
        if (state.bodies[wall.body].type != BodyType::Static || wall.trigger || rare_traits_of(state, wall).one_way != Vec2{} ||
            !may_collide(state, shape, other))
            return true;
        const Pose pose = state.sims[static_cast<std::size_t>(wall.body)].pose();
        const FramePath frame{{pose.position.x - start.x, pose.position.y - start.y}, {}, pose.rotation.c, pose.rotation.s, 0};
        const std::optional<Touch> hit = first_touch(leaf_view(state, other), frame, {&disc}, path, part, 0);
        if (hit)
            part = hit->time; // 0 where the core is in the wall already and would go deeper
        return true;
    };
    const FloatBox box = box_around(start, core.radius, displacement.x, displacement.y);
    state.broad_phase.query(Layer::Resting, box, visit);
    for (const std::int32_t half_space : state.broad_phase.unbounded())
    {
        if (reaches_half_space(state, half_space, box, 0))
            visit(half_space);
    }
    return part;
}

// Most bodies move where nothing rests, and so do their neighbors: the first query in a block of eight answers for all of them.
bool neighbours_meet_nothing(const StepContext& ctx, int body, const FloatBox& box)
{
    const BroadPhase& broad_phase = ctx.state.broad_phase;
    const int shape = ctx.state.bodies[body].first_shape;
    const int block = shape != none && broad_phase.has(shape) ? broad_phase.block_of(shape) : -1;
    if (block < 0)
        return false;
    const FloatBox bounds = broad_phase.block_bounds(block);
    const FloatBox around = grow(bounds, 0.1f * (bounds.ux - bounds.lx + bounds.uy - bounds.ly));
    if (!contains(around, box))
        return false;
    const std::atomic_ref surroundings(ctx.scratch.flight.surroundings[static_cast<std::size_t>(block)]);
    Surroundings known = surroundings.load(std::memory_order_relaxed);
    if (known == Surroundings::Unknown)
    { // other workers may query at the same time, with the same result
        const bool clear = broad_phase.query(Layer::Resting, around, [](int) { return false; });
        known = clear ? Surroundings::Clear : Surroundings::Taken;
        surroundings.store(known, std::memory_order_relaxed);
    }
    return known == Surroundings::Clear;
}

bool may_meet_walls(const StepContext& ctx, int body, double dx, double dy)
{
    const SceneState& state = ctx.state;
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    const FloatBox box = box_around(sim.center, static_cast<double>(sim.extent), dx, dy);
    const bool free =
        neighbours_meet_nothing(ctx, body, box) || state.broad_phase.query(Layer::Resting, box, [](int) { return false; });
    const std::vector<std::int32_t>& half_spaces = state.broad_phase.unbounded();
    return !free || std::any_of(half_spaces.begin(), half_spaces.end(),
                                [&](std::int32_t half_space) { return reaches_half_space(state, half_space, box, 0); });
}

} // namespace

void forget_surroundings(StepContext& ctx)
{
    ctx.scratch.flight.surroundings.assign(static_cast<std::size_t>(ctx.state.broad_phase.block_count()), Surroundings::Unknown);
}

Position free_displacement(const StepContext& ctx, int body, Position displacement, Rotation rotation)
{
    const SceneState& state = ctx.state;
    if (!may_meet_walls(ctx, body, displacement.x, displacement.y))
        return displacement;
    const BodySim& sim = state.sims[static_cast<std::size_t>(body)];
    bool met = true;
    for (int pass = 0; pass < most_passes && met; ++pass)
    {
        met = false;
        const auto stop = [&](int shape)
        {
            if (state.shapes[shape].trigger)
                return;
            const Core core = core_of(leaf_view(state, shape));
            const Vec2 arm = rotate(sim.previous_rotation, core.center - sim.local_center);
            const Vec2 turned = rotate(rotation, core.center - sim.local_center) - arm;
            const Position own{displacement.x + static_cast<double>(turned.x), displacement.y + static_cast<double>(turned.y)};
            const double part = free_part(ctx, shape, core, sim.center + arm, own);
            met |= part < nearly_all;
            displacement.x -= (1 - part) * own.x;
            displacement.y -= (1 - part) * own.y;
        };
        for_each_leaf(state, body, stop);
    }
    return met ? Position{} : displacement;
}

} // namespace carom::internal
