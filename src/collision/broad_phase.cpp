// Maintenance of the broad phase's trees: insertion, removal, changes of boxes, and rebuilding.

#include "collision/broad_phase.h"

#include "core/grow.h"

#include <algorithm>
#include <iterator>

namespace carom::internal {

namespace {

constexpr std::size_t items_per_task = 1024;

} // namespace

void BroadPhase::insert(int item, const FloatBox& box, Layer layer, ItemTraits traits, const FilterBits& filter)
{
    grow(m_places, static_cast<std::size_t>(item) + 1);
    grow(m_leaves, static_cast<std::size_t>(item) + 1);
    grow(m_filters, static_cast<std::size_t>(item) + 1);
    m_filters[static_cast<std::size_t>(item)] = filter;
    m_places[static_cast<std::size_t>(item)] = {{}, layer, traits, box, {}};
    m_leaves[static_cast<std::size_t>(item)] = {};
    stand_still(item);
    m_trigger_count += traits.trigger ? 1 : 0;
    if (traits.unbounded)
        m_unbounded.insert(std::lower_bound(m_unbounded.begin(), m_unbounded.end(), item), item);
    else
        add_recent(item, layer);
}

void BroadPhase::remove(int item)
{
    if (!has(item))
        return;
    SweptBox& place = m_places[static_cast<std::size_t>(item)];
    if (place.traits.unbounded)
        std::erase(m_unbounded, item);
    else
        take_out(item);
    m_trigger_count -= place.traits.trigger ? 1 : 0;
    place = {};
}

void BroadPhase::set_trigger(int item, bool trigger)
{
    if (!has(item))
        return;
    bool& was = m_places[static_cast<std::size_t>(item)].traits.trigger;
    m_trigger_count += (trigger ? 1 : 0) - (was ? 1 : 0);
    was = trigger;
}

void BroadPhase::move_to(int item, Layer layer)
{
    SweptBox& place = m_places[static_cast<std::size_t>(item)];
    if (place.layer == layer)
        return;
    if (!place.traits.unbounded)
    {
        take_out(item);
        add_recent(item, layer);
    }
    place.layer = layer;
    stand_still(item);
    if (layer == Layer::Moving)
        renew(item);
}

void BroadPhase::stand_still(int item)
{
    SweptBox& place = m_places[static_cast<std::size_t>(item)];
    place.path = {place.box, {}, 0};
}

void BroadPhase::set_box(int item, const FloatBox& box)
{
    widen(item, box);
    stand_still(item);
    renew(item);
}

void BroadPhase::widen(int item, const FloatBox& box)
{
    SweptBox& place = m_places[static_cast<std::size_t>(item)];
    place.box = box;
    const Leaf leaf = m_leaves[static_cast<std::size_t>(item)];
    if (!place.traits.unbounded && leaf.tree >= 0)
        m_forests[static_cast<std::size_t>(place.layer)].trees[static_cast<std::size_t>(leaf.tree)].update(leaf.index, box);
}

void BroadPhase::set_filter(int item, const FilterBits& filter)
{
    if (!has(item))
        return;
    m_filters[static_cast<std::size_t>(item)] = filter;
    const Leaf leaf = m_leaves[static_cast<std::size_t>(item)];
    const SweptBox& place = m_places[static_cast<std::size_t>(item)];
    if (!place.traits.unbounded && leaf.tree >= 0)
        m_forests[static_cast<std::size_t>(place.layer)].trees[static_cast<std::size_t>(leaf.tree)].widen_filter(leaf.index,
                                                                                                                 filter);
}

bool BroadPhase::update_moving(const TaskHooks& tasks, std::span<const std::int32_t> items, std::span<const FloatBox> boxes)
{
    Forest& forest = m_forests[0];
    std::size_t total = forest.recent.size();
    for (const BoxTree& tree : forest.trees)
        total += static_cast<std::size_t>(tree.live_count());
    // Fitting all boxes costs about as much as widening a quarter of the paths, leaves a better tree, and lets whole blocks search for new overlaps at once.
    const bool many = items.size() * 16 > total;
    if (many)
    {
        for_each_in_chunks(tasks, items.size(), items_per_task,
                           [&](std::size_t i) { m_places[static_cast<std::size_t>(items[i])].box = boxes[i]; });
        fit_moving(tasks);
        return true;
    }
    for (std::size_t i = 0; i < items.size(); ++i)
        widen(items[i], boxes[i]);
    return false;
}

// The tree is sorted anew only now and then: neighbors remain neighbors for a few steps.
void BroadPhase::fit_moving(const TaskHooks& tasks)
{
    Forest& forest = m_forests[0];
    if (++m_fits < fits_per_sort && forest.trees.size() == 1 && forest.recent.empty())
        forest.trees[0].refit(tasks, [&](std::int32_t item) { return box(item); });
    else
        rebuild(tasks, forest, 0);
    set_size(m_past, static_cast<std::size_t>(block_count()));
}

void BroadPhase::choose_all_but(Layer layer, std::span<const std::int32_t> left_out, std::vector<std::uint8_t>& chosen) const
{
    const std::vector<BoxTree>& trees = m_forests[static_cast<std::size_t>(layer)].trees;
    const auto blocks_before = [&](std::int32_t tree)
    {
        std::size_t blocks = 0;
        for (std::int32_t t = 0; t < tree; ++t)
            blocks += static_cast<std::size_t>(trees[static_cast<std::size_t>(t)].block_count());
        return blocks;
    };
    chosen.assign(blocks_before(static_cast<std::int32_t>(trees.size())), BoxTree::all_lanes);
    for (const std::int32_t item : left_out)
    {
        const Leaf leaf = m_leaves[static_cast<std::size_t>(item)];
        if (leaf.tree < 0 || m_places[static_cast<std::size_t>(item)].layer != layer)
            continue;
        const auto block = static_cast<std::size_t>(leaf.index / BoxTree::arity);
        chosen[blocks_before(leaf.tree) + block] &= static_cast<std::uint8_t>(~(1u << (leaf.index % BoxTree::arity)));
    }
}

// Prefetches the boxes of a block's leaves; where there are few, a cache holds them anyway.
void BroadPhase::prefetch_block(const BoxTree& tree, int block) const
{
    constexpr int few = 65'536;
    const int first = block * BoxTree::arity;
    if (tree.leaf_count() <= few || first + BoxTree::arity > tree.leaf_count())
        return;
    for (int leaf = first; leaf < first + BoxTree::arity; ++leaf)
        prefetch_place(std::max(tree.item(leaf), 0));
}

void BroadPhase::note_changes(int block)
{
    const BoxTree& tree = m_forests[0].trees[0];
    prefetch_block(tree, block + 2);
    BlockPast& past = m_past[static_cast<std::size_t>(block)];
    past.changed = 0;
    for (int i = 0; i < BoxTree::arity; ++i)
    {
        const int leaf = block * BoxTree::arity + i;
        const std::int32_t item = leaf < tree.leaf_count() ? tree.item(leaf) : -1;
        past.before.set(i, item >= 0 ? box_before(item) : FloatBox{});
        past.changed |= item >= 0 && has_changed(item) ? 1u << i : 0u;
    }
}

void BroadPhase::add_recent(int item, Layer layer)
{
    Forest& forest = m_forests[static_cast<std::size_t>(layer)];
    m_leaves[static_cast<std::size_t>(item)] = {-1, static_cast<std::int32_t>(forest.recent.size())};
    forest.recent.push_back(item);
    if (forest.recent.size() > recent_limit)
        merge_recent(forest);
}

void BroadPhase::take_out(int item)
{
    Leaf& leaf = m_leaves[static_cast<std::size_t>(item)];
    Forest& forest = m_forests[static_cast<std::size_t>(m_places[static_cast<std::size_t>(item)].layer)];
    if (leaf.tree < 0)
    {
        const auto index = static_cast<std::size_t>(leaf.index);
        forest.recent[index] = forest.recent.back();
        m_leaves[static_cast<std::size_t>(forest.recent[index])].index = leaf.index;
        forest.recent.pop_back();
        return;
    }
    const auto t = static_cast<std::size_t>(leaf.tree);
    BoxTree& tree = forest.trees[t];
    tree.remove(leaf.index);
    leaf = {};
    if (tree.live_count() * 2 < tree.leaf_count())
        rebuild({}, forest, t);
}

// Merges every tree that is not at least twice as large as everything merged after it.
void BroadPhase::merge_recent(Forest& forest)
{
    std::size_t from = forest.trees.size();
    std::size_t size = forest.recent.size();
    while (from > 0 && static_cast<std::size_t>(forest.trees[from - 1].live_count()) < 2 * size)
        size += static_cast<std::size_t>(forest.trees[--from].live_count());
    rebuild({}, forest, from);
}

// The trees from from_tree on, and the items that are in no tree yet, become one.
void BroadPhase::rebuild(const TaskHooks& tasks, Forest& forest, std::size_t from_tree)
{
    std::vector<std::int32_t> items;
    for (std::size_t t = from_tree; t < forest.trees.size(); ++t)
        std::ranges::copy_if(forest.trees[t].items(), std::back_inserter(items), [](std::int32_t item) { return item >= 0; });
    append_all(items, forest.recent);
    forest.recent.clear();
    if (&forest == &m_forests[0])
        m_fits = 0;
    forest.trees.resize(items.empty() ? from_tree : from_tree + 1);
    if (items.empty())
        return;
    std::vector<TreeLeaf> leaves(items.size());
    for_each_in_chunks(tasks, items.size(), items_per_task,
                       [&](std::size_t i)
                       {
                           const std::int32_t item = items[i];
                           leaves[i] = {box(item), item, m_filters[static_cast<std::size_t>(item)]};
                       });
    BoxTree& tree = forest.trees.back();
    tree.build(tasks, leaves);
    for_each_in_chunks(tasks, leaves.size(), items_per_task,
                       [&](std::size_t i)
                       {
                           const int leaf = static_cast<int>(i);
                           m_leaves[static_cast<std::size_t>(tree.item(leaf))] = {static_cast<std::int32_t>(from_tree), leaf};
                       });
}

} // namespace carom::internal
