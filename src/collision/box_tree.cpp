#include "collision/box_tree.h"

#include "core/assert.h"

namespace carom::internal {

namespace {

// Spreads 16 bits to the even places.
std::uint32_t spread(std::uint32_t x)
{
    x = (x | (x << 8)) & 0x00ff00ffu;
    x = (x | (x << 4)) & 0x0f0f0f0fu;
    x = (x | (x << 2)) & 0x33333333u;
    return (x | (x << 1)) & 0x55555555u;
}

std::uint32_t grid(float v, float low, float scale)
{
    const float g = (v - low) * scale;
    return g > 0 ? static_cast<std::uint32_t>(g < 65535 ? g : 65535) : 0;
}

struct Key
{
    std::uint32_t code;
    std::uint32_t index;
};

// Least significant digit first, 8 bits a pass; stable, so that equal codes keep the order they came in.
void radix_sort(std::vector<Key>& keys)
{
    std::vector<Key> other(keys.size());
    for (int shift = 0; shift < 32; shift += 8)
    {
        std::uint32_t counts[257] = {};
        for (const Key& k : keys)
            ++counts[((k.code >> shift) & 255u) + 1];
        for (int i = 0; i < 256; ++i)
            counts[i + 1] += counts[i];
        for (const Key& k : keys)
            other[counts[(k.code >> shift) & 255u]++] = k;
        keys.swap(other);
    }
}

} // namespace

void BoxTree::build(std::span<const TreeLeaf> leaves)
{
    FloatBox centers;
    for (const TreeLeaf& leaf : leaves)
    {
        const float x = 0.5f * (leaf.box.lx + leaf.box.ux);
        const float y = 0.5f * (leaf.box.ly + leaf.box.uy);
        centers = unite(centers, {x, y, x, y});
    }
    const float width = std::fmax(centers.ux - centers.lx, centers.uy - centers.ly);
    const float scale = width > 0 ? 65535 / width : 0;
    std::vector<Key> keys(leaves.size());
    for (std::size_t i = 0; i < leaves.size(); ++i)
    {
        const FloatBox& b = leaves[i].box;
        keys[i] = {spread(grid(0.5f * (b.lx + b.ux), centers.lx, scale)) |
                       (spread(grid(0.5f * (b.ly + b.uy), centers.ly, scale)) << 1),
                   static_cast<std::uint32_t>(i)};
    }
    radix_sort(keys);
    m_items.resize(leaves.size());
    if (m_levels.empty())
        m_levels.emplace_back();
    std::vector<BoxBlock>& blocks = m_levels[0];
    blocks.resize((leaves.size() + arity - 1) / arity);
    for (std::size_t i = 0; i < blocks.size() * arity; ++i)
    {
        const bool is_leaf = i < keys.size();
        if (is_leaf)
            m_items[i] = leaves[keys[i].index].item;
        blocks[i / arity].set(static_cast<int>(i % arity), is_leaf ? leaves[keys[i].index].box : FloatBox{});
    }
    m_live = static_cast<int>(leaves.size());
    build_levels();
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
