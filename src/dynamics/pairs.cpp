// Stage 2, pairs: boxes that moved or are new ask both layers what they overlap. New pairs are sorted, so that contacts are made in an order
// that depends on nothing but the pairs.

#include "dynamics/body_path.h"
#include "dynamics/contact_store.h"
#include "dynamics/half_space_box.h"
#include "dynamics/stages.h"
#include "dynamics/wake.h"

#include <algorithm>

namespace carom::internal {

namespace {

void offer_pair(StepContext& ctx, int a, int b)
{
    const std::uint64_t key = pair_key(a, b);
    if (a != b && !ctx.state.pairs.contains(key) && may_collide(ctx.state, a, b))
        ctx.scratch.new_pairs.push_back(key);
}

void look_around(StepContext& ctx, int shape, const FloatBox& box)
{
    const SceneState& state = ctx.state;
    const BroadPhase& broad_phase = state.broad_phase;
    const auto offer = [&](int other)
    {
        offer_pair(ctx, shape, other);
        return true;
    };
    if (state.shapes[shape].leaf.type == LeafType::HalfSpace)
    {
        const auto reaches = [&](const FloatBox& other) { return reaches_half_space(state, shape, other, 0); };
        broad_phase.descend(Layer::Moving, reaches, offer);
        broad_phase.descend(Layer::Resting, reaches, offer);
        return;
    }
    broad_phase.query(Layer::Moving, box, offer);
    broad_phase.query(Layer::Resting, box, offer);
    for (const std::int32_t half_space : broad_phase.unbounded())
    {
        if (reaches_half_space(state, half_space, box, 0))
            offer_pair(ctx, shape, half_space);
    }
}

void make_contacts(StepContext& ctx)
{
    std::vector<std::uint64_t>& pairs = ctx.scratch.new_pairs;
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const std::uint64_t key : pairs)
        create_contact(ctx.scene, static_cast<int>(key & 0xffffffffu), static_cast<int>(key >> 32));
}

} // namespace

void find_pairs(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    SceneState& state = ctx.state;
    scratch.new_pairs.clear();
    for (const std::int32_t shape : scratch.moved_items)
        look_around(ctx, shape, state.broad_phase.box(shape));
    for (const std::int32_t shape : state.fresh_shapes)
    {
        if (state.shapes.is_live(shape) && state.broad_phase.has(shape))
            look_around(ctx, shape, state.broad_phase.box(shape));
    }
    state.fresh_shapes.clear();
    make_contacts(ctx);
}

void find_deflected_pairs(StepContext& ctx)
{
    const SceneState& state = ctx.state;
    std::vector<std::uint64_t>& pairs = ctx.scratch.new_pairs;
    pairs.clear();
    for (const Flier& flier : ctx.scratch.fliers)
    {
        if (!flier.deflected || !is_awake(state, flier.body))
            continue;
        const FloatBox way = deflected_box(ctx, flier.body);
        for_each_leaf(state, flier.body,
                      [&](int shape)
                      {
                          if (!contains(state.broad_phase.box(shape), way))
                              look_around(ctx, shape, way);
                      });
    }
    const auto is_trigger = [&](std::uint64_t key)
    { return state.shapes[static_cast<int>(key & 0xffffffffu)].trigger || state.shapes[static_cast<int>(key >> 32)].trigger; };
    std::erase_if(pairs, [&](std::uint64_t key) { return !is_trigger(key); });
    make_contacts(ctx);
}

} // namespace carom::internal
