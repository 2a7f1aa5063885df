// Warm starting across steps of different lengths, see uneven_steps.h.

#include "dynamics/uneven_steps.h"

#include "dynamics/state/scene_data.h"

#include <algorithm>
#include <utility>

namespace carom::internal {

namespace {

constexpr float forgotten_in = 1; // s: in this time the longest recent sub-step decays to a third

template <class Visit>
void for_each_joint(SceneState& state, const Visit& visit)
{
    for (int i = 0; i < state.joints.capacity(); ++i)
    {
        if (state.joints.is_live(i))
            visit(i, state.joints[i].impulses);
    }
}

bool is_short(const StepContext& ctx) { return ctx.h < ctx.state.longest_substep; }

// Lanes have impulses of their own: the next step fills them anew.
void scale_impulses(SceneState& state, float by)
{
    for (ContactImpulses& impulses : state.impulses)
    {
        for (PointImpulses& p : impulses.points)
        {
            p.normal *= by;
            p.tangent *= by;
            p.total_normal *= by;
        }
    }
    for (int i = 0; i < state.contacts.capacity(); ++i)
    {
        if (state.contacts.is_live(i))
            state.contacts[i].manifold.rolling_impulse *= by;
    }
    for_each_joint(state,
                   [by](int, auto& impulses)
                   {
                       for (float& impulse : impulses)
                           impulse *= by;
                   });
    state.graph_dirty = true;
}

} // namespace

void begin_substeps(StepContext& ctx)
{
    SceneState& state = ctx.state;
    const float before = std::exchange(state.substep_of_impulses, ctx.h);
    if (before != 0 && before != ctx.h)
        scale_impulses(state, ctx.h / before);
    const float still_known = state.longest_substep * std::max(1 - ctx.dt / forgotten_in, 0.0f);
    state.longest_substep = std::max(ctx.h, still_known);
}

void save_impulses(StepContext& ctx)
{
    if (!is_short(ctx))
        return;
    Scratch& scratch = ctx.scratch;
    scratch.uneven.impulses_before = ctx.state.impulses;
    scratch.uneven.joint_impulses_before.resize(static_cast<std::size_t>(ctx.state.joints.capacity()));
    for_each_joint(ctx.state, [&](int i, const auto& impulses)
                   { std::ranges::copy(impulses, scratch.uneven.joint_impulses_before[static_cast<std::size_t>(i)].begin()); });
}

void average_saved_impulses(StepContext& ctx)
{
    if (!is_short(ctx))
        return;
    SceneState& state = ctx.state;
    const float share = ctx.h / state.longest_substep;
    const auto average = [share](float before, float& now) { now = before + share * (now - before); };
    for (std::size_t i = 0; i < std::min(state.impulses.size(), ctx.scratch.uneven.impulses_before.size()); ++i)
    {
        for (int k = 0; k < 2; ++k)
        {
            const PointImpulses& before = ctx.scratch.uneven.impulses_before[i].points[k];
            PointImpulses& now = state.impulses[i].points[k];
            average(before.normal, now.normal);
            average(before.tangent, now.tangent);
        }
    }
    for_each_joint(state,
                   [&](int i, auto& impulses)
                   {
                       const auto& before = ctx.scratch.uneven.joint_impulses_before[static_cast<std::size_t>(i)];
                       for (std::size_t k = 0; k < before.size(); ++k)
                           average(before[k], impulses[k]);
                   });
    state.graph_dirty = true;
}

} // namespace carom::internal
