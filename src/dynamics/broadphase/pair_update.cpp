// Pair updates: pairs whose boxes overlap get a contact if they may meet in this step and lose it if they no longer can. Pairs whose boxes have parted are
// removed.

#include "core/grow.h"
#include "core/index.h"
#include "core/prefetch.h"
#include "core/task_pool.h"
#include "dynamics/broadphase/contact_batch.h"
#include "dynamics/broadphase/half_space_box.h"
#include "dynamics/solver/simd/kernels.h"
#include "dynamics/stages.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <bit>
#include <span>

namespace carom::internal {

namespace {

constexpr std::size_t pairs_per_task = 2048;
constexpr std::uint32_t every_lane = (1u << lane_count) - 1;

bool is_trigger(const BroadPhase& boxes, const BoxPair& pair)
{
    return boxes.traits(pair.a).trigger || boxes.traits(pair.b).trigger;
}

bool is_plain(const BroadPhase& boxes, const BoxPair& pair)
{
    return !is_trigger(boxes, pair) && !boxes.traits(pair.a).unbounded && !boxes.traits(pair.b).unbounded;
}

// The contact of two moving shapes is destroyed at a larger gap than it is created at, so that it does not flicker. Shapes at rest get contacts from farther
// away: a body that is struck on its path must not be led into them.
bool may_meet_in_step(const StepContext& ctx, const BoxPair& pair)
{
    const BroadPhase& boxes = ctx.state.broad_phase;
    const bool early = pair.contact == none && boxes.moves(pair.a) && boxes.moves(pair.b);
    if (least_gap(boxes.path(pair.a), boxes.path(pair.b)) <= (early ? 0.5f : 1.0f) * ctx.scene.tolerances.box_margin)
        return true;
    // Triggers and half-spaces are tested by fat boxes: a body may be thrown into a trigger that is not on its path.
    return !is_plain(boxes, pair) && boxes_meet(ctx.state, pair.a, pair.b);
}

// Update of a pair of which at least one shape moves. near: it may meet in this step; meet: its fat boxes overlap. Filters may have changed since the pair was
// found. The end of a touch must still be reported.
std::uint8_t update_of_moving(const StepContext& ctx, const BoxPair& pair, bool near, bool meet)
{
    const SceneState& state = ctx.state;
    const bool has_contact = pair.contact != none;
    const std::uint8_t parted = meet ? 0 : pair_update::parted;
    if (near == has_contact) // unchanged
        return near ? parted : meet ? 0 : pair_update::goes;
    if (near)
        return may_collide(state, pair.a, pair.b) ? pair_update::gets_contact | parted : parted;
    if ((state.contacts[pair.contact].flags & (contact_flag::touching | contact_flag::trigger)) != 0)
        return parted;
    return meet ? pair_update::loses_contact : pair_update::loses_contact | pair_update::goes;
}

std::uint8_t update_of(const StepContext& ctx, const BoxPair& pair)
{
    const SceneState& state = ctx.state;
    const BroadPhase& boxes = state.broad_phase;
    if (!boxes.has(pair.a) || !boxes.has(pair.b))
        return pair_update::goes;
    const bool meet = boxes_meet(state, pair.a, pair.b);
    if (boxes.moves(pair.a) || boxes.moves(pair.b))
        return update_of_moving(ctx, pair, may_meet_in_step(ctx, pair), meet);
    // A trigger also detects shapes at rest, once.
    const bool seen = is_trigger(boxes, pair) && meet && pair.contact == none && may_collide(state, pair.a, pair.b);
    return seen ? pair_update::gets_contact | pair_update::goes : pair_update::goes;
}

// A pair that may need an update.
struct SeenPair
{
    std::int32_t pair;
    bool plain;
    bool near;
    bool meet;
};

// Prefetches what decides the update.
[[gnu::always_inline]] inline void prefetch_pair(const SceneState& state, const BoxPair& pair)
{
    if (pair.contact != none)
    {
        prefetch(state.contacts[pair.contact]);
        return;
    }
    prefetch(state.shapes[pair.a]);
    prefetch(state.shapes[pair.b]);
}

// Prefetches the boxes of eight pairs.
[[gnu::always_inline]] inline void prefetch_boxes(const SweptBox* places, const BoxPair* pairs)
{
    for (const BoxPair& pair : std::span(pairs, lane_count))
    {
        prefetch_line(places + pair.a);
        prefetch_line(places + pair.b);
    }
}

// Updates of a task's pairs. Most pairs need none.
void find_updates(const StepContext& ctx, std::size_t first, std::size_t last, std::vector<PairUpdate>& updates)
{
    const std::vector<BoxPair>& pairs = ctx.state.box_pairs;
    const SweptBox* places = ctx.state.broad_phase.places();
    const WideKernels& kernels = wide_kernels();
    const bool are_far = pairs.size() > most_near_pairs;
    const auto add = [&](std::size_t i, std::uint8_t what)
    {
        if (what != 0)
            append(updates, {static_cast<std::int32_t>(i), what});
    };
    updates.clear();
    SeenPair changes[pairs_per_task];
    std::size_t count = 0;
    std::size_t i = first;
    for (; i + lane_count <= last; i += lane_count)
    {
        if (are_far && i + 4 * lane_count <= last)
            prefetch_boxes(places, &pairs[i + 3 * lane_count]);
        SeenPairs seen;
        kernels.look_at_pairs(&pairs[i], places, ctx.scene.tolerances.box_margin, seen);
        for (std::uint32_t others = ~seen.stay & every_lane; others != 0; others &= others - 1)
        {
            const int lane = std::countr_zero(others);
            const std::size_t k = i + static_cast<std::size_t>(lane);
            const auto has = [lane](std::uint32_t lanes) { return (lanes >> lane & 1u) != 0; };
            changes[count++] = {static_cast<std::int32_t>(k), has(seen.plain), has(seen.near), has(seen.meet)};
            prefetch_pair(ctx.state, pairs[k]);
        }
    }
    for (const SeenPair& seen : std::span(changes, count))
    {
        const BoxPair& pair = pairs[static_cast<std::size_t>(seen.pair)];
        add(static_cast<std::size_t>(seen.pair),
            seen.plain ? update_of_moving(ctx, pair, seen.near, seen.meet) : update_of(ctx, pair));
    }
    for (; i < last; ++i)
        add(i, update_of(ctx, pairs[i]));
}

// Applies pair updates, in the order of pairs.
class PairUpdates
{
public:
    explicit PairUpdates(StepContext& ctx)
        : m_ctx(ctx), m_state(ctx.state), m_batch(ctx), m_of_triggers(ctx.scratch.broad.pairs_of_triggers),
          m_going(ctx.scratch.order)
    {
        m_of_triggers.clear();
        m_going.clear();
    }

    void fulfil(std::span<const PairUpdate> updates)
    {
        for (std::size_t i = 0; i < updates.size(); ++i)
        {
            if (i + 2 * prefetch_distance < updates.size())
                prefetch_line(&m_state.box_pairs[as_index(updates[i + 2 * prefetch_distance].pair)]);
            if (i + prefetch_distance < updates.size())
                prefetch_contact(m_state.box_pairs[as_index(updates[i + prefetch_distance].pair)]);
            fulfil(updates[i]);
        }
    }

    // Pairs of triggers may be found twice, see find_deflected_pairs.
    void finish_contacts()
    {
        m_batch.finish();
        for (const std::int32_t index : m_of_triggers)
        {
            const BoxPair pair = m_state.box_pairs[as_index(index)];
            if (!has_contact(m_state, pair.a, pair.b))
                create_contact(m_ctx.scene, pair.a, pair.b, index);
        }
    }

    // Iterates backwards, since the last pair fills each gap.
    void take_out_going()
    {
        for (auto i = m_going.rbegin(); i != m_going.rend(); ++i)
            take_out(as_index(*i));
    }

private:
    // Prefetches a contact that may be destroyed.
    [[gnu::always_inline]] void prefetch_contact(const BoxPair& pair) const
    {
        if (pair.contact == none)
            return;
        prefetch_line(&m_state.contacts[pair.contact]);
        prefetch_line(&m_state.contacts.generation(pair.contact));
    }

    void fulfil(const PairUpdate& pair_update)
    {
        const BoxPair& pair = m_state.box_pairs[as_index(pair_update.pair)];
        if ((pair_update.what & pair_update::parted) != 0)
            append(m_state.parted_pairs, pair_key(pair.a, pair.b));
        if ((pair_update.what & pair_update::gets_contact) != 0)
            is_trigger(m_state.broad_phase, pair) ? append(m_of_triggers, pair_update.pair) : m_batch.make(pair_update.pair);
        if ((pair_update.what & pair_update::loses_contact) != 0)
            m_batch.destroy(pair.contact);
        if ((pair_update.what & pair_update::goes) != 0)
            append(m_going, pair_update.pair);
    }

    void take_out(std::size_t index)
    {
        std::vector<BoxPair>& pairs = m_state.box_pairs;
        const auto set_place = [&](const BoxPair& pair, std::int32_t place)
        {
            if (pair.contact != none)
                m_state.contacts[pair.contact].pair = place;
        };
        set_place(pairs[index], none);
        if (index + 1 < pairs.size())
        {
            pairs[index] = pairs.back();
            set_place(pairs[index], static_cast<std::int32_t>(index));
        }
        pairs.pop_back();
    }

    StepContext& m_ctx;
    SceneState& m_state;
    ContactBatch m_batch;
    std::vector<std::int32_t>& m_of_triggers;
    std::vector<std::int32_t>& m_going;
};

} // namespace

void follow_pairs(StepContext& ctx)
{
    SceneState& state = ctx.state;
    const std::span<std::vector<PairUpdate>> parts = find_in_chunks(
        ctx.scene.def.tasks, state.box_pairs.size(), pairs_per_task, ctx.scratch.broad.pair_updates_of_task,
        [&](std::size_t first, std::size_t last, std::vector<PairUpdate>& some) { find_updates(ctx, first, last, some); });
    state.parted_pairs.clear();
    PairUpdates updates(ctx);
    for (const std::vector<PairUpdate>& some : parts)
        updates.fulfil(some);
    updates.finish_contacts();
    run_both(ctx.scene.def.tasks, [&] { updates.take_out_going(); }, [&] { std::ranges::sort(state.parted_pairs); });
}

} // namespace carom::internal
