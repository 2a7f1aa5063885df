#include "dynamics/unit_rows.h"

#include "core/task_pool.h"
#include "dynamics/joint_solver.h"
#include "dynamics/prepare.h"
#include "dynamics/wide_kernels.h"
#include "dynamics/wide_prepare.h"

namespace carom::internal {

namespace {

constexpr std::size_t groups_per_part = 64;
constexpr std::size_t rows_per_part = 512;

std::size_t as_index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Each of `count` places from the first on.
template <class Visit>
void for_each_place(const TaskHooks& hooks, std::int32_t begin, std::int32_t count, std::size_t part, const Visit& visit)
{
    for_each_in_parts(hooks, as_index(count), part, [&](std::size_t i) { visit(begin + static_cast<std::int32_t>(i)); });
}

// The unit's g-th.
void fill_group(const StepContext& ctx, const Unit& unit, std::int32_t g)
{
    const Scratch& scratch = ctx.scratch;
    const std::int32_t first_lane = (unit.first_wide + g) * lane_count;
    WideRow& row = ctx.scratch.wide_rows[as_index(unit.wide_store + g)];
    const bool is_full = scratch.lane_links[as_index(first_lane + lane_count - 1)] != none;
    is_full ? start_wide_row(row) : empty_wide_row(unit.first_state, row);
    for (int i = 0; i < lane_count; ++i)
    {
        const std::int32_t link = scratch.lane_links[as_index(first_lane + i)];
        if (link == none)
            break;
        const Link& l = scratch.solved_links[as_index(link)];
        Contact& contact = ctx.state.contacts[l.contact];
        contact.color = l.color;
        contact.wide = (unit.wide_store + g) * lane_count + i;
        fill_lane(ctx, l, row, i);
    }
    wide_kernels().prepare(&row, 1);
}

void fill_row(const StepContext& ctx, const Unit& unit, std::int32_t i)
{
    const Link& l = ctx.scratch.solved_links[as_index(ctx.scratch.row_links[as_index(i)])];
    Contact& contact = ctx.state.contacts[l.contact];
    contact.color = l.color;
    ContactRow& row = ctx.scratch.rows[as_index(i)];
    row = prepare_row(ctx, l.contact, contact.manifold, l.a, l.b);
    follow_closely(contact, unit, row);
}

// A part begins with a group of its own.
void fill_joint_lanes(const StepContext& ctx, const Unit& unit, const TaskHooks& hooks)
{
    const std::vector<JointLane>& lanes = ctx.scratch.joint_lanes;
    const std::size_t begin = as_index(unit.first_joint_lane);
    const std::size_t end = begin + as_index(unit.joint_lane_count);
    const auto next_group = [&](std::size_t i)
    {
        while (i > begin && i < end && lanes[i].lane / lane_count == lanes[i - 1].lane / lane_count)
            ++i;
        return i;
    };
    run_parts(hooks, end - begin, rows_per_part,
              [&](std::size_t first, std::size_t last)
              {
                  for (std::size_t i = next_group(begin + first); i < next_group(begin + last); ++i)
                  {
                      const JointLane& l = lanes[i];
                      WideJoint& group = ctx.scratch.wide_joints[as_index(l.lane / lane_count)];
                      if (l.lane % lane_count == 0)
                          group = empty_wide_joint(l.fixed);
                      fill_joint_lane(ctx, l.place.joint, l.place.a, l.place.b, group, l.lane % lane_count);
                  }
              });
}

void commit_joint(const StepContext& ctx, const JointWork& work)
{
    JointRecord& joint = ctx.state.joints[work.joint];
    joint.force = (1 / ctx.dt) * work.force_sum;
    joint.torque = work.torque_sum / ctx.dt;
}

} // namespace

void fill_unit(const StepContext& ctx, const Unit& unit, const TaskHooks& hooks)
{
    const StepContext unit_ctx = unit.slices > 1 ? sliced(ctx, unit.slices) : ctx;
    for_each_place(hooks, 0, unit.wide_count, groups_per_part, [&](std::int32_t g) { fill_group(unit_ctx, unit, g); });
    for_each_place(hooks, unit.first_row, unit.row_count, rows_per_part, [&](std::int32_t i) { fill_row(unit_ctx, unit, i); });
    for_each_place(hooks, unit.first_joint, unit.joint_count, rows_per_part,
                   [&](std::int32_t i)
                   {
                       const JointPlace& place = ctx.scratch.joint_places[as_index(i)];
                       ctx.scratch.joints[as_index(i)] = prepare_joint(unit_ctx, place.joint, place.a, place.b);
                   });
    fill_joint_lanes(unit_ctx, unit, hooks);
}

void commit_unit(const StepContext& ctx, const Unit& unit, const TaskHooks& hooks)
{
    const Scratch& scratch = ctx.scratch;
    for_each_place(hooks, unit.wide_store, unit.wide_count, groups_per_part,
                   [&](std::int32_t g) { commit_wide_row(ctx.state, scratch.wide_rows[as_index(g)]); });
    for_each_place(hooks, unit.first_row, unit.row_count, rows_per_part,
                   [&](std::int32_t i) { commit_row(ctx.state, scratch.rows[as_index(i)]); });
    for_each_place(hooks, unit.first_joint, unit.joint_count, rows_per_part,
                   [&](std::int32_t i) { commit_joint(ctx, scratch.joints[as_index(i)]); });
    for_each_place(hooks, unit.first_wide_joint, unit.wide_joint_count, groups_per_part,
                   [&](std::int32_t g) { commit_wide_joint(ctx, scratch.wide_joints[as_index(g)]); });
}

void commit_row(SceneState& state, const ContactRow& row)
{
    Contact& contact = state.contacts[row.contact];
    Manifold& m = contact.manifold;
    m.normal = row.n;
    m.count = row.count;
    m.rolling_impulse = row.rolling_impulse;
    contact.flags &= ~contact_flag::loaded;
    for (int i = 0; i < row.count; ++i)
    {
        const RowPoint& p = row.points[i];
        m.points[i].anchor_a = p.ra;
        m.points[i].anchor_b = p.rb;
        m.points[i].normal_impulse = p.normal_impulse;
        m.points[i].tangent_impulse = p.tangent_impulse;
        m.points[i].total_impulse = p.total_impulse;
        m.points[i].total_tangent = p.total_tangent;
        if (p.normal_impulse > 0)
            contact.flags |= contact_flag::loaded;
    }
}

} // namespace carom::internal
