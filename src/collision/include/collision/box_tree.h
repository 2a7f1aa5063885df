#pragma once

// A static tree of boxes: leaves along a Hilbert curve, each node the union of eight children in sequence. No pointers: level k of the tree
// is an array an eighth as long as level k - 1, and the children of node i are 8 i ... 8 i + 7. Siblings are stored side by side, a coordinate
// at a time, so that all eight are tested at once. Building it is a radix sort and one pass. Boxes may shrink, grow and vanish
// afterwards without moving.

#include "core/float4.h"
#include "core/task_pool.h"
#include "geometry/bounds.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

/// Collision filter of an item, or the union of filters below a node: its categories, and the categories that it collides with.
struct FilterBits
{
    std::uint64_t categories = ~std::uint64_t{0};
    std::uint64_t masks = ~std::uint64_t{0};
};

[[nodiscard]] inline bool may_meet(const FilterBits& a, const FilterBits& b)
{
    return (a.categories & b.masks) != 0 && (b.categories & a.masks) != 0;
}

inline void widen(FilterBits& all, const FilterBits& more)
{
    all.categories |= more.categories;
    all.masks |= more.masks;
}

struct TreeLeaf
{
    FloatBox box;
    std::int32_t item;
    FilterBits filter{};
};

/// Eight boxes; empty ones overlap nothing.
struct alignas(32) BoxBlock
{
    static constexpr int size = 8;

    float lx[size];
    float ly[size];
    float ux[size];
    float uy[size];

    [[nodiscard]] FloatBox box(int i) const { return {lx[i], ly[i], ux[i], uy[i]}; }
    void set(int i, const FloatBox& b)
    {
        lx[i] = b.lx;
        ly[i] = b.ly;
        ux[i] = b.ux;
        uy[i] = b.uy;
    }
    [[nodiscard]] FloatBox bounds() const
    {
        FloatBox all;
        for (int i = 0; i < size; ++i)
            all = unite(all, box(i));
        return all;
    }

    /// One bit per box, set where it overlaps.
    [[nodiscard]] unsigned overlapping(const FloatBox& b) const { return overlapping_half(b, 0) | overlapping_half(b, 4) << 4; }

private:
    [[nodiscard]] unsigned overlapping_half(const FloatBox& b, int i) const
    {
        return bits((load4(lx + i) <= b.ux) & (load4(ux + i) >= b.lx) & (load4(ly + i) <= b.uy) & (load4(uy + i) >= b.ly));
    }
};

class BoxTree
{
public:
    static constexpr int arity = BoxBlock::size;
    static constexpr unsigned all_lanes = (1u << arity) - 1;
    static constexpr std::size_t blocks_per_task = 64;
    static constexpr int max_levels = 12; // 8^11 leaves

    void build(const TaskHooks& tasks, std::span<const TreeLeaf> leaves);
    /// Sets new boxes for all leaves, whose order is unchanged: box_of(item).
    template <class BoxOf>
    void refit(const TaskHooks& tasks, const BoxOf& box_of)
    {
        for_each_in_chunks(tasks, m_levels[0].size(), blocks_per_task,
                           [&](std::size_t k)
                           {
                               const std::size_t end = std::min((k + 1) * arity, m_items.size());
                               for (std::size_t i = k * arity; i < end; ++i)
                               {
                                   if (m_items[i] >= 0)
                                       m_levels[0][k].set(static_cast<int>(i % arity), box_of(m_items[i]));
                               }
                           });
        build_levels();
    }

    /// Replaces a leaf's box; the boxes above it grow as needed.
    void update(int leaf, const FloatBox& box);
    /// Widens the filters above a leaf by its new filter.
    void widen_filter(int leaf, const FilterBits& filter);
    /// Gives a leaf an empty box, which overlaps nothing. The leaf stays until the next build.
    void remove(int leaf);

    [[nodiscard]] int leaf_count() const { return static_cast<int>(m_items.size()); }
    [[nodiscard]] int live_count() const { return m_live; }
    /// Items in the order of the leaves.
    [[nodiscard]] std::span<const std::int32_t> items() const { return {m_items.data(), m_items.size()}; }
    /// The item of a leaf; -1 where it was removed.
    [[nodiscard]] std::int32_t item(int leaf) const { return m_items[static_cast<std::size_t>(leaf)]; }
    [[nodiscard]] FloatBox box(int leaf) const { return block(leaf / arity).box(leaf % arity); }
    [[nodiscard]] FloatBox bounds() const { return m_items.empty() ? FloatBox{} : m_levels.back()[0].bounds(); }

    /// Leaves are stored in blocks of eight neighbors: leaf i is box i % 8 of block i / 8.
    [[nodiscard]] int block_count() const { return m_items.empty() ? 0 : static_cast<int>(m_levels[0].size()); }
    [[nodiscard]] const BoxBlock& block(int i) const { return m_levels[0][static_cast<std::size_t>(i)]; }

    /// Level 0 holds the leaves; node i of a level covers block i of the level below.
    [[nodiscard]] int level_count() const { return static_cast<int>(m_levels.size()); }
    [[nodiscard]] const BoxBlock* level(int i) const { return m_levels[static_cast<std::size_t>(i)].data(); }
    /// By the blocks of a level, the union of all filters that have been below them since the tree was built.
    [[nodiscard]] const FilterBits* filters(int level) const { return m_filters[static_cast<std::size_t>(level)].data(); }
    [[nodiscard]] const FilterBits& filter() const { return m_filters.back()[0]; }

    [[nodiscard]] FloatBox block_bounds(int i) const
    {
        return m_levels.size() > 1 ? m_levels[1][static_cast<std::size_t>(i / arity)].box(i % arity) : block(i).bounds();
    }

    /// Calls visit(block) for every block of leaves that may have an overlapping box.
    template <class Visit>
    void query_blocks(const FloatBox& box, Visit&& visit) const
    {
        walk([&](const BoxBlock& k) { return k.overlapping(box); }, 1,
             [&](std::int32_t node)
             {
                 visit(node);
                 return true;
             });
    }

    /// Calls visit(item) for every leaf whose box overlaps; visit returns false to stop. The result is false if it was stopped.
    template <class Visit>
    bool query(const FloatBox& box, Visit&& visit) const
    {
        return walk([&](const BoxBlock& k) { return k.overlapping(box); }, 0,
                    [&](std::int32_t leaf) { return visit(m_items[static_cast<std::size_t>(leaf)]); });
    }

    /// The same for any test of boxes that holds for a node whenever it holds for a child, and never for an empty box.
    template <class Test, class Visit>
    bool descend(Test&& test, Visit&& visit) const
    {
        const auto test_all = [&](const BoxBlock& k)
        {
            unsigned hits = 0;
            for (int i = 0; i < arity; ++i)
                hits |= k.lx[i] <= k.ux[i] && test(k.box(i)) ? 1u << i : 0u;
            return hits;
        };
        return walk(test_all, 0, [&](std::int32_t leaf) { return visit(m_items[static_cast<std::size_t>(leaf)]); });
    }

    /// Calls visit(own leaf, other leaf) where leaves of block k, given as one bit each, overlap leaves of another tree: in its block o those in lanes_of(o).
    /// The eight leaves traverse it together.
    template <class LanesOf, class Visit>
    void for_each_overlap(int k, unsigned lanes, const BoxTree& others, const LanesOf& lanes_of, const Visit& visit) const
    {
        FloatBox around;
        for (unsigned l = lanes; l != 0; l &= l - 1)
            around = unite(around, block(k).box(std::countr_zero(l)));
        others.query_blocks(around,
                            [&](int other)
                            {
                                const unsigned asked = lanes_of(other);
                                unsigned near = lanes & block(k).overlapping(others.block_bounds(other));
                                for (; asked != 0 && near != 0; near &= near - 1)
                                {
                                    const int i = std::countr_zero(near);
                                    for (unsigned hits = asked & others.block(other).overlapping(block(k).box(i)); hits != 0;
                                         hits &= hits - 1)
                                        visit(k * arity + i, other * arity + std::countr_zero(hits));
                                }
                            });
    }

private:
    // Descends to the nodes of a level: 0 the leaves, 1 the blocks of leaves.
    template <class Test, class Visit>
    bool walk(const Test& test, int last_level, const Visit& visit) const
    {
        if (m_items.empty())
            return true;
        struct Entry
        {
            std::int32_t level; ///< level of the nodes in the block
            std::int32_t block;
        };
        Entry stack[arity * max_levels];
        int depth = 0;
        const auto top = static_cast<std::int32_t>(m_levels.size()) - 1;
        if (top < last_level)
            return visit(0);
        stack[depth++] = {top, 0};
        while (depth > 0)
        {
            const Entry e = stack[--depth];
            unsigned hits = test(m_levels[static_cast<std::size_t>(e.level)][static_cast<std::size_t>(e.block)]);
            for (; hits != 0; hits &= hits - 1)
            {
                const std::int32_t node = e.block * arity + std::countr_zero(hits);
                if (e.level == last_level)
                {
                    if (!visit(node))
                        return false;
                }
                else
                {
                    stack[depth++] = {e.level - 1, node};
                }
            }
        }
        return true;
    }

    void build_levels();
    void build_filters();

    std::vector<std::int32_t> m_items;
    std::vector<std::vector<BoxBlock>> m_levels;    ///< [0]: leaves
    std::vector<std::vector<FilterBits>> m_filters; ///< by level and block
    int m_live = 0;
};

} // namespace carom::internal
