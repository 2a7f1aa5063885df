// Stage 2, pairs: boxes that moved or are new ask both layers what they overlap. New pairs are sorted, so that contacts are made in an order
// that depends on nothing but the pairs. Of the pairs those get a contact that may meet in this step: what falls side by side does not.

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

void add_pairs(StepContext& ctx)
{
    std::vector<std::uint64_t>& pairs = ctx.scratch.new_pairs;
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    for (const std::uint64_t key : pairs)
    {
        ctx.state.pairs.insert(key);
        ctx.state.box_pairs.push_back({static_cast<std::int32_t>(key & 0xffffffffu), static_cast<std::int32_t>(key >> 32), none});
    }
}

bool is_trigger_or_unbounded(const ShapeRecord& shape) { return shape.trigger || shape.leaf.type == LeafType::HalfSpace; }

// A contact of two that move goes a little later than it would come, so that it does not flicker. What rests is seen from farther: a body that
// is struck on its way must not be led into it.
bool may_meet_in_step(const StepContext& ctx, const BoxPair& pair)
{
    const SceneState& state = ctx.state;
    const BoxPath& a = state.broad_phase.path(pair.a);
    const BoxPath& b = state.broad_phase.path(pair.b);
    const bool early = pair.contact == none && a.moves && b.moves;
    if (may_meet(a, b, (early ? 0.5f : 1.0f) * ctx.scene.tolerances.box_margin))
        return true;
    // These are asked by their fat boxes: a body may be thrown into a trigger that it did not go for.
    return (is_trigger_or_unbounded(state.shapes[pair.a]) || is_trigger_or_unbounded(state.shapes[pair.b])) &&
           boxes_meet(state, pair.a, pair.b);
}

// Contacts of pairs that may meet; those that can't any more lose theirs, unless it must still tell of its end. False: no pair any more.
bool follow_pair(StepContext& ctx, std::size_t index)
{
    SceneState& state = ctx.state;
    const BoxPair pair = state.box_pairs[index];
    if (!state.broad_phase.has(pair.a) || !state.broad_phase.has(pair.b))
        return false;
    if (!state.broad_phase.path(pair.a).moves && !state.broad_phase.path(pair.b).moves)
    { // triggers see what rests as well, once
        const bool trigger = state.shapes[pair.a].trigger || state.shapes[pair.b].trigger;
        if (trigger && pair.contact == none && boxes_meet(state, pair.a, pair.b) && may_collide(state, pair.a, pair.b))
            create_contact(ctx.scene, pair.a, pair.b, static_cast<std::int32_t>(index));
        return false;
    }
    if (may_meet_in_step(ctx, pair))
    {
        if (pair.contact == none && may_collide(state, pair.a, pair.b))
            create_contact(ctx.scene, pair.a, pair.b, static_cast<std::int32_t>(index));
        return true;
    }
    if (pair.contact != none)
    {
        if ((state.contacts[pair.contact].flags & (contact_flag::touching | contact_flag::trigger)) != 0)
            return true;
        destroy_contact(ctx.scene, pair.contact, ctx.scene.events, 0);
    }
    return boxes_meet(state, pair.a, pair.b);
}

void follow_pairs(StepContext& ctx)
{
    SceneState& state = ctx.state;
    std::vector<BoxPair>& pairs = state.box_pairs;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < pairs.size(); ++i)
    {
        if (!follow_pair(ctx, i))
        {
            if (pairs[i].contact == none)
                state.pairs.erase(pair_key(pairs[i].a, pairs[i].b));
            else
                state.contacts[pairs[i].contact].pair = none;
            continue;
        }
        if (kept != i)
        {
            pairs[kept] = pairs[i];
            if (pairs[kept].contact != none)
                state.contacts[pairs[kept].contact].pair = static_cast<std::int32_t>(kept);
        }
        ++kept;
    }
    pairs.resize(kept);
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
    add_pairs(ctx);
    follow_pairs(ctx);
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
    const std::size_t first = ctx.state.box_pairs.size();
    add_pairs(ctx);
    for (std::size_t i = first; i < ctx.state.box_pairs.size(); ++i)
        create_contact(ctx.scene, ctx.state.box_pairs[i].a, ctx.state.box_pairs[i].b, static_cast<std::int32_t>(i));
}

} // namespace carom::internal
