#pragma once

// Which boxes overlap. Two layers: what moves (awake bodies) and what rests (static and sleeping ones), so that the resting world costs
// nothing per step. A layer is a few trees, each at least twice as large as the next: new boxes gather in a short list and are
// merged into trees of growing size, so that adding one shape to a million costs little.
// Boxes without bounds (half-spaces) stand in a list of their own.

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

/// A leaf's box at the start of a step, and how it moves in it.
struct BoxPath
{
    FloatBox box{};
    Vec2 shift{};       ///< of the whole box, along its path
    float any_path = 0; ///< how far any point of it may come beside that
};

/// What sets an item apart from those with a box that meet what they touch.
struct ItemTraits
{
    bool trigger = false;
    bool unbounded = false; ///< a half-space
};

[[nodiscard]] inline F4 swept(F4 box, Vec2 displacement, float any_path)
{
    const F4 shift = four_of(displacement.x, displacement.y, displacement.x, displacement.y);
    return grown(box + low_and_high(least(shift, F4{}), greatest(shift, F4{})), any_path);
}

/// The box around all that it covers.
[[nodiscard]] inline FloatBox swept(const BoxPath& p) { return box_of(swept(load4(&p.box.lx), p.shift, p.any_path)); }

/// How near the two may come, less than 0 where they may meet. Seen from one of them: what moves along with it stays away.
[[nodiscard]] inline float least_gap(const BoxPath& a, const BoxPath& b)
{
    const F4 d = four_of(b.shift.x - a.shift.x, b.shift.y - a.shift.y, a.shift.x - b.shift.x, a.shift.y - b.shift.y);
    const F4 from = load4(&b.box.lx);
    const F4 to = load4(&a.box.lx);
    const F4 low = low_halves(from, to) + least(d, F4{});
    const F4 gap = low - high_halves(to, from);
    const F4 by_axis = greatest(gap, swapped_halves(gap));
    return first_lane(greatest(by_axis, swapped_neighbours(by_axis))) - (a.any_path + b.any_path);
}

/// All that decides about an item's pairs.
struct alignas(64) SweptBox
{
    BoxPath path{};
    Layer layer = Layer::None;
    ItemTraits traits{};
    FloatBox box{};
    FloatBox before{};
};
static_assert(sizeof(SweptBox) == 64);

/// Eight neighbours of the moving layer, when pairs were last looked for.
struct BlockPast
{
    BoxBlock before;
    unsigned changed = 0; ///< a bit for each whose box is another one now
};

/// The tree of the moving layer, its levels from the leaves up, and what its blocks of leaves were.
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

    /// The boxes of these items of the moving layer changed. Few: their paths in the tree are widened; many: all boxes are fitted anew, and now
    /// and then sorted. True: all are fitted.
    bool update_moving(const TaskHooks& tasks, std::span<const std::int32_t> items, std::span<const FloatBox> boxes);

    /// Of this step; between steps, and for what rests, the box stands still.
    void set_path(int item, const BoxPath& path) { m_places[static_cast<std::size_t>(item)].path = path; }
    [[nodiscard]] const BoxPath& path(int item) const { return m_places[static_cast<std::size_t>(item)].path; }
    [[nodiscard]] bool moves(int item) const { return m_places[static_cast<std::size_t>(item)].layer == Layer::Moving; }
    [[nodiscard]] ItemTraits traits(int item) const { return m_places[static_cast<std::size_t>(item)].traits; }

    /// Asks memory for all that decides about the item's pairs.
    [[gnu::always_inline]] void prefetch_place(int item) const
    {
        if (item < static_cast<int>(m_places.size()))
            prefetch(m_places[static_cast<std::size_t>(item)]);
    }

    /// For kernels that write its path.
    [[nodiscard]] SweptBox& place(int item) { return m_places[static_cast<std::size_t>(item)]; }
    /// By item.
    [[nodiscard]] const SweptBox* places() const { return m_places.data(); }
    [[nodiscard]] const FloatBox& box(int item) const { return m_places[static_cast<std::size_t>(item)].box; }
    [[nodiscard]] bool has(int item) const
    {
        return item < static_cast<int>(m_places.size()) && m_places[static_cast<std::size_t>(item)].layer != Layer::None;
    }

    /// Its box when pairs were last looked for; empty for what is new, or must look for all its pairs again.
    [[nodiscard]] const FloatBox& box_before(int item) const { return m_places[static_cast<std::size_t>(item)].before; }
    [[nodiscard]] bool has_changed(int item) const
    {
        const SweptBox& p = m_places[static_cast<std::size_t>(item)];
        return p.box.lx != p.before.lx || p.box.ly != p.before.ly || p.box.ux != p.before.ux || p.box.uy != p.before.uy;
    }
    void renew(int item) { m_places[static_cast<std::size_t>(item)].before = {}; }
    /// Pairs have been looked for.
    void settle(int item)
    {
        SweptBox& p = m_places[static_cast<std::size_t>(item)];
        p.before = p.box;
    }

    /// Calls visit(item) for every box that overlaps; false from visit stops.
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

    /// Of the blocks of a layer's trees, one tree after the other, a bit for each item but those that are left out; and for empty boxes, which nothing
    /// overlaps.
    void choose_all_but(Layer layer, std::span<const std::int32_t> left_out, std::vector<std::uint8_t>& chosen) const;

    /// Calls visit(item, other) where boxes of block k of a tree, a bit for each, overlap those of a layer: of its trees what was chosen, and what is in
    /// none of them yet.
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

    /// Blocks of eight neighbours of the moving layer: all of it where update_moving has fitted all boxes.
    [[nodiscard]] int block_count() const { return m_forests[0].trees.empty() ? 0 : m_forests[0].trees[0].block_count(); }

    /// Which of these holds an item; -1: none.
    [[nodiscard]] int block_of(int item) const
    {
        const Leaf leaf = m_leaves[static_cast<std::size_t>(item)];
        return moves(item) && leaf.tree == 0 ? leaf.index / BoxTree::arity : -1;
    }
    [[nodiscard]] FloatBox block_bounds(int block) const { return m_forests[0].trees[0].block_bounds(block); }

    /// Notes what has changed in a block; before anything looks for new overlaps.
    void note_changes(int block);

    /// For kernels that look for what has come to overlap among these; leaf i of block k stands for moving_item(8 k + i).
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

    /// Calls visit(item, other) where the box of an item of this block has changed and overlaps one of the resting layer that it did not before. Left out are
    /// those whose filters say that they do not meet, as far as whole blocks and trees show it.
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
    static constexpr std::size_t recent_limit = 32; // longer lists cost queries more than the merge they put off

    struct Leaf
    {
        std::int32_t tree = -1;  ///< -1: in the recent list
        std::int32_t index = -1; ///< in the tree, or place in the list
    };

    struct Forest
    {
        std::vector<BoxTree> trees;
        std::vector<std::int32_t> recent;
    };

    // Calls visit(item, other) where boxes of block k of a tree, a bit for each, overlap those that no tree holds yet.
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
    std::vector<Leaf> m_leaves;        ///< by item, as the places
    std::vector<FilterBits> m_filters; ///< by item
    Forest m_forests[2];
    std::vector<BlockPast> m_past; ///< of the blocks of the moving layer, once all are fitted
    std::vector<std::int32_t> m_unbounded;
    std::int32_t m_trigger_count = 0;
    int m_fits = 0; ///< of the moving layer since it was sorted
};

} // namespace carom::internal
