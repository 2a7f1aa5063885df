// Fills an island's constraints and joints from records before it is solved, and commits impulses afterwards.

#include "dynamics/solver/island_constraints.h"

#include "core/index.h"
#include "core/prefetch.h"
#include "core/refuse.h"
#include "dynamics/solver/contact/partitions.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/solver/contact/prepare_wide.h"
#include "dynamics/solver/joint/joint_solver.h"
#include "dynamics/solver/simd/kernels.h"

#include <algorithm>
#include <functional>
#include <span>

namespace carom::internal {

namespace {

constexpr int enough_constraints = 256; // to share among threads

// Visits each of `count` slots from `begin` on.
template <class Visit>
void for_each_place(WorkerTeam& team, std::int32_t begin, std::int32_t count, const Visit& visit)
{
    team.share(count, enough_constraints,
               [&](int first, int last)
               {
                   for (std::int32_t i = begin + first; i < begin + last; ++i)
                       visit(i);
               });
}

// Prefetches the contact of a lane that is filled later.
[[gnu::always_inline]] inline void prefetch_lane(const StepContext& ctx, std::size_t lane)
{
    const Scratch& scratch = ctx.scratch;
    if (lane >= scratch.layout.lane_edges.size() || scratch.layout.lane_edges[lane] == none)
        return;
    const std::int32_t contact = scratch.layout.solved_edges[as_index(scratch.layout.lane_edges[lane])].contact;
    prefetch(ctx.state.contacts[contact]);
    prefetch(ctx.state.impulses[as_index(contact)]);
}

// Fills block g of the island.
void fill_block(const StepContext& ctx, const Island& island, std::int32_t g)
{
    const Scratch& scratch = ctx.scratch;
    const std::int32_t first_lane = (island.first_wide + g) * lane_count;
    WideContact& constraint = ctx.scratch.solver.wide_contacts[as_index(island.wide_store + g)];
    WideContactNotes& notes = ctx.scratch.solver.wide_notes[as_index(island.wide_store + g)];
    WideFeatures& features = ctx.scratch.solver.wide_features[as_index(island.wide_store + g)];
    notes.count = notes.featured = 0;
    for (int i = 0; i < lane_count; ++i)
    {
        prefetch_lane(ctx, as_index(first_lane + i) + 2 * prefetch_distance);
        const std::int32_t edge = scratch.layout.lane_edges[as_index(first_lane + i)];
        if (edge == none)
        {
            constraint.a.v[i] = constraint.b.v[i] = island.first_state;
            notes.contact.v[i] = none;
            continue;
        }
        const SolvedEdge& l = scratch.layout.solved_edges[as_index(edge)];
        constraint.a.v[i] = l.a;
        constraint.b.v[i] = l.b;
        notes.contact.v[i] = l.contact;
        notes.count = static_cast<std::int8_t>(l.points()); // the same in all lanes
        notes.featured = l.has(edge_flag::plain) ? 0 : 1;
        Contact& contact = ctx.state.contacts[l.contact];
        contact.wide = (island.wide_store + g) * lane_count + i;
        ctx.state.lane_marks[as_index(l.contact)] = LaneMark::InLane;
    }
    wide_kernels().fill(constraint, notes, &ctx.state.contacts[0], ctx.state.impulses.data(), scratch.solver.states.data(),
                        scratch.solver.constants.data(), halfway_gap(ctx));
    for (int i = 0; notes.featured != 0 && i < lane_count; ++i)
        fill_features(ctx.state, notes.contact.v[i], features, i);
}

void take_rolling_impulses(SceneState& state, const WideContactNotes& notes, const WideFeatures& features)
{
    for (int i = 0; i < lane_count; ++i)
    {
        if (notes.contact.v[i] != none)
            state.contacts[notes.contact.v[i]].manifold.rolling_impulse = features.rolling_impulse.v[i];
    }
}

void fill_constraint(const StepContext& ctx, const Island& island, std::int32_t i)
{
    const SolvedEdge& l = ctx.scratch.layout.solved_edges[as_index(ctx.scratch.layout.constraint_edges[as_index(i)])];
    const Contact& contact = ctx.state.contacts[l.contact];
    ContactConstraint& constraint = ctx.scratch.solver.constraints[as_index(i)];
    constraint = prepare_constraint(ctx, l.contact, contact.manifold, l.a, l.b);
    follow_closely(contact, island, constraint);
    if (island.policy.wide_contacts)
        turn_arms(ctx.scratch, constraint);
}

// Prefetches the hinge of a lane that is filled later, and the bodies of a hinge that is filled sooner.
[[gnu::always_inline]] inline void prefetch_hinge(const SceneState& state, std::span<const JointLane> later)
{
    if (later.size() > 2 * prefetch_distance)
        prefetch(state.joints[later[2 * prefetch_distance].place.joint]);
    if (later.size() <= prefetch_distance)
        return;
    const JointRecord& joint = state.joints[later[prefetch_distance].place.joint];
    for (const std::int32_t body : {joint.body_a, joint.body_b})
    {
        if (body != none)
            prefetch_line(&state.sims[as_index(body)]); // the half that neighbors read
    }
}

void fill_joint_block(const StepContext& ctx, WideJoint& block)
{
    wide_kernels().fill_joints(block, &ctx.state.joints[0], ctx.state.sims.data(), ctx.state.turns.data(),
                               ctx.scratch.solver.constants.data(), ctx.h);
}

void fill_joint_blocks(const StepContext& ctx, const Island& island, int first, int last)
{
    const auto lanes =
        std::span(ctx.scratch.layout.joint_lanes).subspan(as_index(island.first_joint_lane), as_index(island.joint_lane_count));
    const auto of_block = [&](int g)
    { return std::ranges::lower_bound(lanes, (island.first_wide_joint + g) * lane_count, {}, &JointLane::lane); };
    auto l = of_block(first);
    for (int g = island.first_wide_joint + first; g < island.first_wide_joint + last; ++g)
    {
        WideJoint& block = ctx.scratch.solver.wide_joints[as_index(g)];
        std::ranges::fill(block.a.v, island.first_state);
        std::ranges::fill(block.b.v, island.first_state);
        std::ranges::fill(block.joint.v, none);
        for (; l != lanes.end() && l->lane / lane_count == g; ++l)
        {
            prefetch_hinge(ctx.state, {l, lanes.end()});
            const int i = l->lane % lane_count;
            block.a.v[i] = l->place.a;
            block.b.v[i] = l->place.b;
            block.joint.v[i] = l->place.joint;
            block.turns = l->bucket % 2; // the same in all lanes
        }
        fill_joint_block(ctx, block);
    }
}

void follow_joint_blocks(const StepContext& ctx, const Island& island, int first, int last)
{
    for (WideJoint& block :
         std::span(ctx.scratch.solver.wide_joints).subspan(as_index(island.first_wide_joint + first), as_index(last - first)))
    {
        if (block.turns == 0)
            wide_kernels().follow_joints(block, ctx.state.sims.data());
        else
            fill_joint_block(ctx, block);
    }
}

void commit_joint(const StepContext& ctx, const JointWork& work)
{
    JointRecord& joint = ctx.state.joints[work.joint];
    joint.force = (1 / ctx.dt) * work.force_sum;
    joint.torque = work.torque_sum / ctx.dt;
    if (!is_finite(joint.force) || !is_finite(joint.torque))
        forget_loads(joint); // the solver cannot warm start from loads that are not finite
    std::ranges::transform(work.errors(), work.moved, joint.left_errors, std::minus<>());
    joint.yields = work.yields;
}

} // namespace

void fill_island(const StepContext& ctx, const Island& island, WorkerTeam& team)
{
    const StepContext island_ctx = step_of(ctx, island);
    if (ctx.scratch.reuse != Reuse::Constraints)
        contact_buckets(ctx.scratch, island).for_each(team, [&](int g) { fill_block(island_ctx, island, g); });
    for_each_place(team, island.first_constraint, island.constraint_count,
                   [&](std::int32_t i) { fill_constraint(island_ctx, island, i); });
    for_each_place(team, island.first_joint, island.joint_count,
                   [&](std::int32_t i)
                   {
                       const SolvedJoint& place = ctx.scratch.layout.joints_outside_lanes[as_index(i)];
                       ctx.scratch.solver.joints[as_index(i)] = prepare_joint(island_ctx, island, place);
                   });
    joint_buckets(ctx.scratch, island)
        .all(team,
             [&](int first, int last)
             {
                 if (ctx.scratch.reuse != Reuse::Nothing)
                     follow_joint_blocks(island_ctx, island, first, last);
                 else
                     fill_joint_blocks(island_ctx, island, first, last);
             });
}

void commit_island(const StepContext& ctx, const Island& island, WorkerTeam& team)
{
    Scratch& scratch = ctx.scratch;
    WideContact* const constraints = scratch.solver.wide_contacts.data() + island.wide_store;
    WideContactNotes* const notes = scratch.solver.wide_notes.data() + island.wide_store;
    const WideFeatures* const features = scratch.solver.wide_features.data() + island.wide_store;
    contact_buckets(scratch, island)
        .for_each(team,
                  [&](int g)
                  {
                      if (are_constraints_far(island))
                      { // prefetching beyond the last block does no harm
                          prefetch(constraints[as_index(g) + prefetch_distance]);
                          prefetch(notes[as_index(g) + prefetch_distance]);
                      }
                      wide_kernels().take_impulses(constraints[g], notes[g], &ctx.state.contacts[0], ctx.state.impulses.data());
                      if (notes[g].featured != 0)
                          take_rolling_impulses(ctx.state, notes[g], features[g]);
                  });
    for_each_place(team, island.first_constraint, island.constraint_count,
                   [&](std::int32_t i) { commit_constraint(ctx.state, scratch.solver.constraints[as_index(i)]); });
    for_each_place(team, island.first_joint, island.joint_count,
                   [&](std::int32_t i) { commit_joint(ctx, scratch.solver.joints[as_index(i)]); });
    joint_buckets(scratch, island)
        .for_each(team,
                  [&](int g)
                  {
                      wide_kernels().take_joint_impulses(scratch.solver.wide_joints[as_index(island.first_wide_joint + g)],
                                                         &ctx.state.joints[0], ctx.dt);
                  });
}

void commit_constraint(SceneState& state, const ContactConstraint& constraint)
{
    Contact& contact = state.contacts[constraint.contact];
    Manifold& m = contact.manifold;
    m.normal = constraint.n;
    m.count = constraint.count;
    m.rolling_impulse = constraint.rolling_impulse;
    contact.flags &= ~contact_flag::loaded;
    for (int i = 0; i < constraint.count; ++i)
    {
        const ConstraintPoint& p = constraint.points[i];
        m.points[i].anchor_a = p.ra;
        m.points[i].anchor_b = p.rb;
        impulses_of(state, constraint.contact).points[i] = {p.normal_impulse, p.tangent_impulse, p.total_impulse,
                                                            p.total_tangent};
        if (p.normal_impulse > 0)
            contact.flags |= contact_flag::loaded;
    }
}

} // namespace carom::internal
