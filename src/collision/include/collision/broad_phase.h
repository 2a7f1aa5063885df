#pragma once

// The broad phase: which boxes overlap. There are two layers, moving (awake bodies) and resting (static and sleeping ones), so that the resting world costs
// nothing per step. A layer is a few trees, each at least twice as large as the next. New boxes gather in a short list and are
// merged into trees of growing size, so that adding one shape to a million costs little.
// Boxes without bounds (half-spaces) are in a separate list.

#include "collision/box_tree.h"
#include "core/prefetch.h"

#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

enum class Layer : std::int8_t
{
    None = -1,
    Moving = 0,
    Resting = 1,
};

/// A leaf's box at the start of a step, and its motion during the step.
struct BoxPath
{
    FloatBox box{};
    Vec2 shift{};               ///< displacement of the whole box
    float any_displacement = 0; ///< bound on the displacement of any point of it besides that
};

/// Properties that set an item apart from bounded leaves with contact response.
struct ItemTraits
{
    bool trigger = false;
    bool unbounded = false; ///< a half-space
};

[[nodiscard]] inline F4 swept(F4 box, Vec2 displacement, float any_displacement)
{
    const F4 shift = four_of(displacement.x, displacement.y, displacement.x, displacement.y);
    return grown(box + low_and_high(least(shift, F4{}), greatest(shift, F4{})), any_displacement);
}

/// The box around all that the path covers.
[[nodiscard]] inline FloatBox swept(const BoxPath& p) { return box_of(swept(load4(&p.box.lx), p.shift, p.any_displacement)); }

/// Lower bound on the gap of two boxes along their paths; less than 0 where they may meet. The relative motion counts, so boxes that move together stay apart.
[[nodiscard]] inline float least_gap(const BoxPath& a, const BoxPath& b)
{
    const F4 d = four_of(b.shift.x - a.shift.x, b.shift.y - a.shift.y, a.shift.x - b.shift.x, a.shift.y - b.shift.y);
    const F4 from = load4(&b.box.lx);
    const F4 to = load4(&a.box.lx);
    const F4 low = low_halves(from, to) + least(d, F4{});
    const F4 gap = low - high_halves(to, from);
    const F4 by_axis = greatest(gap, swapped_halves(gap));
    return first_lane(greatest(by_axis, swapped_neighbours(by_axis))) - (a.any_displacement + b.any_displacement);
}

/// The data that decides which pairs an item has.
struct alignas(64) SweptBox
{
    BoxPath path{};
    Layer layer = Layer::None;
    ItemTraits traits{};
    FloatBox box{};
    FloatBox before{};
};
static_assert(sizeof(SweptBox) == 64);

/// Boxes of a block of eight neighbors in the moving layer at the last search for pairs.
struct BlockPast
{
    BoxBlock before;
    unsigned changed = 0; ///< one bit per box, set where it differs now
};

/// The tree of the moving layer, its levels from the leaves up, and the earlier boxes of its blocks of leaves.
struct MovingBlocks
{
    const BoxBlock* levels[BoxTree::max_levels];
    const FilterBits* filters[BoxTree::max_levels];
    std::int32_t level_count;
    const BlockPast* past;
};

class BroadPhase
{
public:
    void insert(int item, const FloatBox& box, Layer layer, ItemTraits traits, const FilterBits& filter = {});
    void remove(int item);
    void move_to(int item, Layer layer);
    void set_box(int item, const FloatBox& box);
    void set_trigger(int item, bool trigger);
    [[nodiscard]] bool has_triggers() const { return m_trigger_count > 0; }

    void set_filter(int item, const FilterBits& filter);

    /// Sets the changed boxes of these items of the moving layer. For few items, their paths in the tree are widened; for many, all boxes are fitted anew and
    /// from time to time sorted. True where all are fitted.
    bool update_moving(const TaskHooks& tasks, std::span<const std::int32_t> items, std::span<const FloatBox> boxes);

    /// Sets the path of the current step. Between steps, and for resting items, the box stands still.
    void set_path(int item, const BoxPath& path) { m_places[static_cast<std::size_t>(item)].path = path; }
    [[nodiscard]] const BoxPath& path(int item) const { return m_places[static_cast<std::size_t>(item)].path; }
    [[nodiscard]] bool moves(int item) const { return m_places[static_cast<std::size_t>(item)].layer == Layer::Moving; }
    [[nodiscard]] ItemTraits traits(int item) const { return m_places[static_cast<std::size_t>(item)].traits; }

    /// Prefetches the data that decides which pairs the item has.
    [[gnu::always_inline]] void prefetch_place(int item) const
    {
        if (item < static_cast<int>(m_places.size()))
            prefetch(m_places[static_cast<std::size_t>(item)]);
    }

    /// For kernels that write the item's path.
    [[nodiscard]] SweptBox& place(int item) { return m_places[static_cast<std::size_t>(item)]; }
    /// Swept boxes by item.
    [[nodiscard]] const SweptBox* places() const { return m_places.data(); }
    [[nodiscard]] const FloatBox& box(int item) const { return m_places[static_cast<std::size_t>(item)].box; }
    [[nodiscard]] bool has(int item) const
    {
        return item < static_cast<int>(m_places.size()) && m_places[static_cast<std::size_t>(item)].layer != Layer::None;
    }

    /// The item's box at the last search for pairs; empty for an item that is new or must search for all its pairs again.
    [[nodiscard]] const FloatBox& box_before(int item) const { return m_places[static_cast<std::size_t>(item)].before; }
    [[nodiscard]] bool has_changed(int item) const
    {
        const SweptBox& p = m_places[static_cast<std::size_t>(item)];
        return p.box.lx != p.before.lx || p.box.ly != p.before.ly || p.box.ux != p.before.ux || p.box.uy != p.before.uy;
    }
    void renew(int item) { m_places[static_cast<std::size_t>(item)].before = {}; }
    /// Marks the search for the item's pairs as done.
    void settle(int item)
    {
        SweptBox& p = m_places[static_cast<std::size_t>(item)];
        p.before = p.box;
    }

    /// Calls visit(item) for every box that overlaps; visit returns false to stop.
    template <class Visit>
    bool query(Layer layer, const FloatBox& box, Visit&& visit) const
    {
        const Forest& forest = m_forests[static_cast<std::size_t>(layer)];
        for (const std::int32_t item : forest.recent)
        {
            if (overlaps(this->box(item), box) && !visit(item))
                return false;
        }
        for (const BoxTree& tree : forest.trees)
        {
            if (!tree.query(box, visit))
                return false;
        }
        return true;
    }

    /// Chooses all items of a layer except those left out: one byte per block, tree after tree, with one bit per item. Bits of empty boxes are set, but these
    /// overlap nothing.
    void choose_all_but(Layer layer, std::span<const std::int32_t> left_out, std::vector<std::uint8_t>& chosen) const;

    /// Calls visit(item, other) where boxes of block k of a tree, given as one bit each, overlap boxes of a layer: the chosen ones in its trees, and all that
    /// are in no tree yet.
    template <class Visit>
    void for_each_overlap(const BoxTree& tree, int k, unsigned lanes, Layer layer, std::span<const std::uint8_t> chosen,
                          const Visit& visit) const
    {
        const Forest& forest = m_forests[static_cast<std::size_t>(layer)];
        for (const BoxTree& others : forest.trees)
        {
            tree.for_each_overlap(
                k, lanes, others, [&](int o) { return unsigned{chosen[static_cast<std::size_t>(o)]}; },
                [&](int own, int other) { visit(tree.item(own), others.item(other)); });
            chosen = chosen.subspan(static_cast<std::size_t>(others.block_count()));
        }
        for_each_recent(tree, k, lanes, forest, visit);
    }

    /// Number of blocks of eight neighbors in the moving layer: all of it where update_moving has fitted all boxes.
    [[nodiscard]] int block_count() const { return m_forests[0].trees.empty() ? 0 : m_forests[0].trees[0].block_count(); }

    /// Index of the block that holds an item; -1: none.
    [[nodiscard]] int block_of(int item) const
    {
        const Leaf leaf = m_leaves[static_cast<std::size_t>(item)];
        return moves(item) && leaf.tree == 0 ? leaf.index / BoxTree::arity : -1;
    }
    [[nodiscard]] FloatBox block_bounds(int block) const { return m_forests[0].trees[0].block_bounds(block); }

    /// Records which boxes of a block have changed; to be called before any search for new overlaps.
    void note_changes(int block);

    /// For kernels that search for new overlaps within the moving layer; leaf i of block k stands for moving_item(8 k + i).
    [[nodiscard]] MovingBlocks moving_blocks() const
    {
        const BoxTree& tree = m_forests[0].trees[0];
        MovingBlocks blocks{{}, {}, tree.level_count(), m_past.data()};
        for (int level = 0; level < tree.level_count(); ++level)
        {
            blocks.levels[level] = tree.level(level);
            blocks.filters[level] = tree.filters(level);
        }
        return blocks;
    }
    [[nodiscard]] std::int32_t moving_item(int leaf) const { return m_forests[0].trees[0].item(leaf); }

    /// Calls visit(item, other) where the box of an item of this block has changed and overlaps a box of the resting layer that it did not overlap before.
    /// Trees are left out where the block's filters exclude all of their items.
    template <class Visit>
    void for_each_new_overlap_at_rest(int k, const Visit& visit) const
    {
        const BoxTree& tree = m_forests[0].trees[0];
        const unsigned changed = m_past[static_cast<std::size_t>(k)].changed;
        const auto if_new = [&](std::int32_t item, std::int32_t other)
        {
            if (!overlaps(box_before(item), box_before(other)))
                visit(item, other);
        };
        for (const BoxTree& others : m_forests[1].trees)
        {
            if (may_meet(tree.filters(0)[k], others.filter()))
                tree.for_each_overlap(
                    k, changed, others, [](int) { return BoxTree::all_lanes; },
                    [&](int own_leaf, int other) { if_new(tree.item(own_leaf), others.item(other)); });
        }
        for_each_recent(tree, k, changed, m_forests[1], if_new);
    }

    template <class Test, class Visit>
    bool descend(Layer layer, Test&& test, Visit&& visit) const
    {
        const Forest& forest = m_forests[static_cast<std::size_t>(layer)];
        for (const std::int32_t item : forest.recent)
        {
            if (test(box(item)) && !visit(item))
                return false;
        }
        for (const BoxTree& tree : forest.trees)
        {
            if (!tree.descend(test, visit))
                return false;
        }
        return true;
    }

    [[nodiscard]] const std::vector<std::int32_t>& unbounded() const { return m_unbounded; }

private:
    static constexpr int fits_per_sort = 8;
    static constexpr std::size_t recent_limit = 32; // longer lists cost queries more than the merge that they postpone

    struct Leaf
    {
        std::int32_t tree = -1;  ///< -1: in the recent list
        std::int32_t index = -1; ///< in the tree, or in the list
    };

    struct Forest
    {
        std::vector<BoxTree> trees;
        std::vector<std::int32_t> recent;
    };

    // Calls visit(item, other) where boxes of block k of a tree, given as one bit each, overlap boxes that are in no tree yet.
    template <class Visit>
    void for_each_recent(const BoxTree& tree, int k, unsigned lanes, const Forest& forest, const Visit& visit) const
    {
        for (const std::int32_t other : forest.recent)
        {
            for (unsigned hits = lanes & tree.block(k).overlapping(box(other)); hits != 0; hits &= hits - 1)
                visit(tree.item(k * BoxTree::arity + std::countr_zero(hits)), other);
        }
    }

    void stand_still(int item);
    void fit_moving(const TaskHooks& tasks);
    void widen(int item, const FloatBox& box);
    void add_recent(int item, Layer layer);
    void take_out(int item);
    void prefetch_block(const BoxTree& tree, int block) const;
    void merge_recent(Forest& forest);
    void rebuild(const TaskHooks& tasks, Forest& forest, std::size_t from_tree);

    std::vector<SweptBox> m_places;
    std::vector<Leaf> m_leaves;        ///< by item, like the swept boxes
    std::vector<FilterBits> m_filters; ///< by item
    Forest m_forests[2];
    std::vector<BlockPast> m_past; ///< by block of the moving layer, once all boxes are fitted
    std::vector<std::int32_t> m_unbounded;
    std::int32_t m_trigger_count = 0;
    int m_fits = 0; ///< fits of the moving layer since it was sorted
};

} // namespace carom::internal
