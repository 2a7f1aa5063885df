// Building and updating of box trees.

#include "collision/box_tree.h"

#include "collision/hilbert_order.h"
#include "core/assert.h"

namespace carom::internal {

void BoxTree::build(const TaskHooks& tasks, std::span<const TreeLeaf> leaves)
{
    HilbertOrder order;
    order.sort(tasks, leaves.size(),
               [&](std::size_t i)
               {
                   const FloatBox& b = leaves[i].box;
                   return Vec2{0.5f * (b.lx + b.ux), 0.5f * (b.ly + b.uy)};
               });
    const std::span<const HilbertOrder::Key> keys = order.keys();
    m_items.resize(leaves.size());
    if (m_levels.empty())
        m_levels.emplace_back();
    std::vector<BoxBlock>& blocks = m_levels[0];
    blocks.resize((leaves.size() + arity - 1) / arity);
    m_filters.resize(1);
    m_filters[0].assign(blocks.size(), {0, 0});
    for_each_in_chunks(tasks, blocks.size(), blocks_per_task,
                       [&](std::size_t k)
                       {
                           for (std::size_t i = k * arity; i < (k + 1) * arity; ++i)
                           {
                               const bool is_leaf = i < keys.size();
                               if (is_leaf)
                               {
                                   m_items[i] = leaves[keys[i].index].item;
                                   widen(m_filters[0][k], leaves[keys[i].index].filter);
                               }
                               blocks[k].set(static_cast<int>(i % arity), is_leaf ? leaves[keys[i].index].box : FloatBox{});
                           }
                       });
    m_live = static_cast<int>(leaves.size());
    build_levels();
    build_filters();
}

void BoxTree::build_filters()
{
    m_filters.resize(m_levels.size());
    for (std::size_t level = 1; level < m_levels.size(); ++level)
    {
        const std::vector<FilterBits>& below = m_filters[level - 1];
        m_filters[level].assign(m_levels[level].size(), {0, 0});
        for (std::size_t i = 0; i < below.size(); ++i)
            widen(m_filters[level][i / arity], below[i]);
    }
}

void BoxTree::widen_filter(int leaf, const FilterBits& filter)
{
    auto block = static_cast<std::size_t>(leaf);
    for (std::vector<FilterBits>& level : m_filters)
    {
        block /= arity;
        widen(level[block], filter);
    }
}

void BoxTree::build_levels()
{
    std::size_t level = 0;
    while (m_levels[level].size() > 1)
    {
        if (++level == m_levels.size())
            m_levels.emplace_back();
        const std::vector<BoxBlock>& below = m_levels[level - 1];
        std::vector<BoxBlock>& blocks = m_levels[level];
        blocks.resize((below.size() + arity - 1) / arity);
        for (std::size_t i = 0; i < blocks.size() * arity; ++i)
            blocks[i / arity].set(static_cast<int>(i % arity), i < below.size() ? below[i].bounds() : FloatBox{});
    }
    m_levels.resize(level + 1);
    CAROM_ASSERT(m_levels.size() <= max_levels, "the query stack holds every level");
}

void BoxTree::update(int leaf, const FloatBox& box)
{
    m_levels[0][static_cast<std::size_t>(leaf / arity)].set(leaf % arity, box);
    for (std::size_t level = 1; level < m_levels.size(); ++level)
    {
        leaf /= arity;
        BoxBlock& above = m_levels[level][static_cast<std::size_t>(leaf / arity)];
        const FloatBox old = above.box(leaf % arity);
        if (contains(old, box))
            return;
        above.set(leaf % arity, unite(old, box));
    }
}

void BoxTree::remove(int leaf)
{
    m_levels[0][static_cast<std::size_t>(leaf / arity)].set(leaf % arity, {});
    m_items[static_cast<std::size_t>(leaf)] = -1;
    --m_live;
}

} // namespace carom::internal
