// Stage 2, pairs: boxes that moved or are new query both layers for overlaps. Pair updates follow in pair_update.cpp.

#include "core/grow.h"
#include "core/pair_set.h"
#include "core/task_pool.h"
#include "dynamics/broadphase/half_space_box.h"
#include "dynamics/continuous/path/body_path.h"
#include "dynamics/sleep/wake.h"
#include "dynamics/solver/simd/kernels.h"
#include "dynamics/stages.h"
#include "dynamics/state/contact_store.h"
#include "geometry/leaf_traits.h"

#include <algorithm>
#include <bit>
#include <span>

namespace carom::internal {

namespace {

constexpr std::size_t blocks_per_task = 32;
constexpr std::size_t boxes_per_task = 2048;
constexpr std::size_t fresh_per_task = 16;

using Pairs = std::vector<std::uint64_t>;

bool is_fresh(const SceneState& state, int shape)
{
    const FloatBox& before = state.broad_phase.box_before(shape);
    return !state.broad_phase.has(shape) || before.lx > before.ux;
}

// Known pairs are found again by shapes that search for all of their pairs, and where boxes had parted before the contact ended.
bool is_known(const SceneState& state, int a, int b)
{
    const bool may_be_known = is_fresh(state, a) || is_fresh(state, b) ||
                              std::binary_search(state.parted_pairs.begin(), state.parted_pairs.end(), pair_key(a, b));
    return may_be_known && has_contact(state, a, b);
}

// Called before boxes are settled.
void offer_pair(const StepContext& ctx, int a, int b, Pairs& pairs)
{
    if (a != b && may_collide(ctx.state, a, b) && !is_known(ctx.state, a, b))
        append(pairs, pair_key(a, b));
}

// Boxes that overlapped at the last search are a pair already. If both boxes have changed, the first finds the second.
void offer_changed(const StepContext& ctx, int shape, int other, Pairs& pairs)
{
    const BroadPhase& boxes = ctx.state.broad_phase;
    const bool known = overlaps(boxes.box_before(shape), boxes.box_before(other));
    if (!known && (shape < other || !boxes.has_changed(other)))
        offer_pair(ctx, shape, other, pairs);
}

void look_at_half_spaces(const StepContext& ctx, int shape, const FloatBox& box, Pairs& pairs)
{
    for (const std::int32_t half_space : ctx.state.broad_phase.unbounded())
    {
        if (reaches_half_space(ctx.state, half_space, box, 0))
            offer_pair(ctx, shape, half_space, pairs);
    }
}

// Offers all pairs of a shape, known or not.
void look_around(const StepContext& ctx, int shape, const FloatBox& box, Pairs& pairs)
{
    const SceneState& state = ctx.state;
    const BroadPhase& broad_phase = state.broad_phase;
    const auto offer = [&](int other)
    {
        offer_pair(ctx, shape, other, pairs);
        return true;
    };
    if (!traits_of(state.shapes[shape].leaf).is_bounded)
    {
        const auto reaches = [&](const FloatBox& other) { return reaches_half_space(state, shape, other, 0); };
        broad_phase.descend(Layer::Moving, reaches, offer);
        broad_phase.descend(Layer::Resting, reaches, offer);
        return;
    }
    broad_phase.query(Layer::Moving, box, offer);
    broad_phase.query(Layer::Resting, box, offer);
    look_at_half_spaces(ctx, shape, box, pairs);
}

// Results are in the order of the tasks, whatever threads run them.
template <class Look>
void look_on_all_threads(StepContext& ctx, std::size_t count, std::size_t part, std::vector<Pairs>& found, const Look& look)
{
    const std::span<Pairs> parts = find_in_chunks(ctx.scene.def.tasks, count, part, found,
                                                  [&](std::size_t first, std::size_t last, Pairs& pairs)
                                                  {
                                                      pairs.clear();
                                                      look(first, last, pairs);
                                                  });
    for (const Pairs& some : parts)
        append_all(ctx.scratch.broad.new_pairs, some);
}

void look_around_box(const StepContext& ctx, int shape, Pairs& pairs)
{
    const BroadPhase& boxes = ctx.state.broad_phase;
    for (const Layer layer : {Layer::Moving, Layer::Resting})
        boxes.query(layer, boxes.box(shape),
                    [&](int other)
                    {
                        offer_changed(ctx, shape, other, pairs);
                        return true;
                    });
}

// New overlaps of a block of the moving layer.
void offer_new_overlaps(const StepContext& ctx, const MovingBlocks& moving, int block, Pairs& pairs)
{
    if (moving.past[block].changed == 0)
        return;
    const BroadPhase& boxes = ctx.state.broad_phase;
    const auto offer = [&](int shape, int other) { offer_pair(ctx, shape, other, pairs); };
    const auto offer_all = [&](int other, std::uint64_t hits)
    {
        for (; hits != 0; hits &= hits - 1)
        {
            const int bit = std::countr_zero(hits);
            offer(boxes.moving_item(block * BoxTree::arity + bit / BoxTree::arity),
                  boxes.moving_item(other * BoxTree::arity + bit % BoxTree::arity));
        }
    };
    using OfferAll = decltype(offer_all);
    const auto note = [](const void* context, std::int32_t other, std::uint64_t hits)
    { (*static_cast<const OfferAll*>(context))(other, hits); };
    wide_kernels().new_overlaps(moving, block, {&offer_all, note});
    boxes.for_each_new_overlap_at_rest(block, offer);
}

void look_around_moved(StepContext& ctx)
{
    BroadPhase& boxes = ctx.state.broad_phase;
    if (ctx.scratch.broad.all_fitted)
    {
        const auto blocks = static_cast<std::size_t>(boxes.block_count());
        for_each_in_chunks(ctx.scene.def.tasks, blocks, blocks_per_task,
                           [&](std::size_t k) { boxes.note_changes(static_cast<int>(k)); });
        const MovingBlocks moving = boxes.moving_blocks();
        look_on_all_threads(ctx, blocks, blocks_per_task, ctx.scratch.broad.pairs_of_task,
                            [&](std::size_t first, std::size_t last, Pairs& pairs)
                            {
                                for (std::size_t k = first; k < last; ++k)
                                    offer_new_overlaps(ctx, moving, static_cast<int>(k), pairs);
                            });
    }
    else
    {
        look_on_all_threads(ctx, ctx.scratch.broad.moved.items.size(), 8 * blocks_per_task, ctx.scratch.broad.pairs_of_task,
                            [&](std::size_t first, std::size_t last, Pairs& pairs)
                            {
                                for (std::size_t i = first; i < last; ++i)
                                    look_around_box(ctx, ctx.scratch.broad.moved.items[i], pairs);
                            });
    }
    if (boxes.unbounded().empty())
        return;
    for (const std::int32_t shape : ctx.scratch.broad.moved.items)
    {
        for (const std::int32_t half_space : boxes.unbounded())
        {
            if (!reaches_half_space(ctx.state, half_space, boxes.box_before(shape), 0) &&
                reaches_half_space(ctx.state, half_space, boxes.box(shape), 0))
                offer_pair(ctx, shape, half_space, ctx.scratch.broad.new_pairs);
        }
    }
}

// Pairs of fresh shapes are found again, except those that have a contact.
void forget_pairs_of_fresh(StepContext& ctx)
{
    SceneState& state = ctx.state;
    std::vector<BoxPair>& pairs = state.box_pairs;
    using Places = std::vector<std::int32_t>;
    std::vector<Places> found;
    const std::span<Places> parts =
        find_in_chunks(ctx.scene.def.tasks, pairs.size(), boxes_per_task, found,
                       [&](std::size_t first, std::size_t last, Places& forgotten)
                       {
                           forgotten.clear();
                           for (std::size_t i = first; i < last; ++i)
                           {
                               if (pairs[i].contact == none && (is_fresh(state, pairs[i].a) || is_fresh(state, pairs[i].b)))
                                   forgotten.push_back(static_cast<std::int32_t>(i));
                           }
                       });
    std::size_t kept = 0;
    std::size_t next = 0;
    const auto keep_until = [&](std::size_t end)
    {
        if (kept == next)
            kept = next = end; // these pairs keep their indices
        for (; next < end; ++next)
        {
            if (pairs[next].contact != none)
                state.contacts[pairs[next].contact].pair = static_cast<std::int32_t>(kept);
            pairs[kept++] = pairs[next];
        }
    };
    for (const Places& forgotten : parts)
    {
        for (const std::int32_t place : forgotten)
        {
            keep_until(static_cast<std::size_t>(place));
            ++next;
        }
    }
    keep_until(pairs.size());
    pairs.resize(kept);
}

void look_around_fresh(StepContext& ctx)
{
    const SceneState& state = ctx.state;
    if (state.fresh_shapes.empty())
        return;
    forget_pairs_of_fresh(ctx);
    std::vector<Pairs> found; // mostly few, rarely many: the memory is not kept
    look_on_all_threads(ctx, state.fresh_shapes.size(), fresh_per_task, found,
                        [&](std::size_t first, std::size_t last, Pairs& pairs)
                        {
                            for (const std::int32_t shape : std::span(state.fresh_shapes).subspan(first, last - first))
                            {
                                if (state.shapes.is_live(shape) && state.broad_phase.has(shape))
                                    look_around(ctx, shape, state.broad_phase.box(shape), pairs);
                            }
                        });
}

void settle(StepContext& ctx)
{
    SceneState& state = ctx.state;
    const std::vector<std::int32_t>& moved = ctx.scratch.broad.moved.items;
    for_each_in_chunks(ctx.scene.def.tasks, moved.size(), boxes_per_task,
                       [&](std::size_t i) { state.broad_phase.settle(moved[i]); });
    for (const std::int32_t shape : state.fresh_shapes)
    {
        if (state.broad_phase.has(shape))
            state.broad_phase.settle(shape);
    }
    state.fresh_shapes.clear();
}

// A pair of two fresh shapes, or of a fresh one and a moved one, is found twice.
void leave_out_doubles(Pairs& pairs)
{
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

void add_pairs(StepContext& ctx)
{
    const Pairs& keys = ctx.scratch.broad.new_pairs;
    std::vector<BoxPair>& pairs = ctx.state.box_pairs;
    const std::size_t known = pairs.size();
    grow(pairs, known + keys.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        pairs[known + i] = {static_cast<std::int32_t>(keys[i] & 0xffffffffu), static_cast<std::int32_t>(keys[i] >> 32), none};
}

} // namespace

void find_pairs(StepContext& ctx)
{
    ctx.scratch.broad.new_pairs.clear();
    look_around_fresh(ctx);
    look_around_moved(ctx);
    if (!ctx.state.fresh_shapes.empty())
        leave_out_doubles(ctx.scratch.broad.new_pairs);
    add_pairs(ctx);
    settle(ctx);
    follow_pairs(ctx);
}

void find_deflected_pairs(StepContext& ctx)
{
    const SceneState& state = ctx.state;
    std::vector<std::uint64_t>& pairs = ctx.scratch.broad.new_pairs;
    pairs.clear();
    if (!state.broad_phase.has_triggers())
        return;
    for (const Flier& flier : ctx.scratch.flight.fliers)
    {
        if (!flier.is_deflected() || !is_awake(state, flier.body))
            continue;
        const FloatBox displacement = deflected_box(ctx, flier.body);
        for_each_leaf(state, flier.body,
                      [&](int shape)
                      {
                          if (!contains(state.broad_phase.box(shape), displacement))
                              look_around(ctx, shape, displacement, pairs);
                      });
    }
    const auto is_trigger = [&](std::uint64_t key)
    { return state.shapes[static_cast<int>(key & 0xffffffffu)].trigger || state.shapes[static_cast<int>(key >> 32)].trigger; };
    const auto has_one = [&](std::uint64_t key)
    { return has_contact(state, static_cast<int>(key & 0xffffffffu), static_cast<int>(key >> 32)); };
    std::erase_if(pairs, [&](std::uint64_t key) { return !is_trigger(key) || has_one(key); });
    leave_out_doubles(pairs);
    const std::size_t first = ctx.state.box_pairs.size();
    add_pairs(ctx);
    for (std::size_t i = first; i < ctx.state.box_pairs.size(); ++i)
        create_contact(ctx.scene, ctx.state.box_pairs[i].a, ctx.state.box_pairs[i].b, static_cast<std::int32_t>(i));
}

} // namespace carom::internal
