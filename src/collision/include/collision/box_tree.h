#pragma once

// A static tree of boxes: leaves in Morton order, each node the union of eight children in sequence. No pointers: level k of the tree
// is an array an eighth as long as level k - 1, and the children of node i are 8 i ... 8 i + 7. Building it is a radix sort and one pass;
// boxes may shrink, grow and vanish afterwards without moving.

#include "geometry/bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace carom::internal {

struct TreeLeaf
{
    FloatBox box;
    std::int32_t item;
};

class BoxTree
{
public:
    static constexpr int arity = 8;
    static constexpr int max_levels = 12; // 8^11 leaves

    void build(std::span<const TreeLeaf> leaves);
    /// Replaces a leaf's box; the boxes above it grow as needed.
    void update(int leaf, const FloatBox& box);
    /// An empty box overlaps nothing. The leaf stays until the next build.
    void remove(int leaf);

    [[nodiscard]] int leaf_count() const { return static_cast<int>(m_items.size()); }
    [[nodiscard]] int live_count() const { return m_live; }
    [[nodiscard]] std::int32_t item(int leaf) const { return m_items[static_cast<std::size_t>(leaf)]; }
    [[nodiscard]] const FloatBox& box(int leaf) const { return m_levels[0][static_cast<std::size_t>(leaf)]; }
    [[nodiscard]] FloatBox bounds() const { return m_items.empty() ? FloatBox{} : m_levels.back()[0]; }

    /// Calls visit(item) for every leaf whose box overlaps; visit returns false to stop. False if stopped.
    template <class Visit>
    bool query(const FloatBox& box, Visit&& visit) const
    {
        return descend([&](const FloatBox& node) { return overlaps(node, box); }, visit);
    }

    /// The same for any test of boxes that holds for a node whenever it holds for a child.
    template <class Test, class Visit>
    bool descend(Test&& test, Visit&& visit) const
    {
        if (m_items.empty())
            return true;
        struct Entry
        {
            std::int32_t level;
            std::int32_t node;
        };
        Entry stack[arity * max_levels];
        int depth = 0;
        const auto root_level = static_cast<std::int32_t>(m_levels.size()) - 1;
        if (test(m_levels.back()[0]))
            stack[depth++] = {root_level, 0};
        while (depth > 0)
        {
            const Entry e = stack[--depth];
            if (e.level == 0)
            {
                if (!visit(m_items[static_cast<std::size_t>(e.node)]))
                    return false;
                continue;
            }
            const std::vector<FloatBox>& below = m_levels[static_cast<std::size_t>(e.level) - 1];
            const std::int32_t first = e.node * arity;
            const std::int32_t last = std::min(first + arity, static_cast<std::int32_t>(below.size()));
            for (std::int32_t i = last; i-- > first;)
            {
                if (test(below[static_cast<std::size_t>(i)]))
                    stack[depth++] = {e.level - 1, i};
            }
        }
        return true;
    }

private:
    void build_levels();

    std::vector<std::int32_t> m_items;
    std::vector<std::vector<FloatBox>> m_levels; ///< [0]: leaves
    int m_live = 0;
};

} // namespace carom::internal
