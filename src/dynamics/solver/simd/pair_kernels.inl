// Finds which pairs of boxes may meet, eight at a time; update_of in pair_update.cpp does the same for
// one. Finds also which boxes newly overlap, one against eight neighbors. Part of kernels.inl.

namespace pairs {

// The data of eight items that decide about their pairs.
struct Boxes
{
    F8 lx, ly, ux, uy;                 ///< at the start of the step
    F8 shift_x, shift_y, any_displacement;      ///< their paths in it
    F8 fat_lx, fat_ly, fat_ux, fat_uy; ///< and the fat ones
    I8 kind;                           ///< layer and traits, a byte each

    template <class Item>
    CAROM_INLINE Boxes(const SweptBox* places, const Item& item)
    {
        static_assert(offsetof(SweptBox, path) == 0 && offsetof(BoxPath, box) == 0 && offsetof(BoxPath, shift) == 16 &&
                      offsetof(BoxPath, any_displacement) == 24 && offsetof(SweptBox, layer) == 28 && offsetof(SweptBox, traits) == 29 &&
                      offsetof(SweptBox, box) == 32 && sizeof(Layer) == 1 && sizeof(ItemTraits) == 2);
        const auto at = [&](int offset)
        { return [&item, places, offset](int i) { return reinterpret_cast<const char*>(places + item(i)) + offset; }; };
        F8 kinds;
        gather4(at(0), lx, ly, ux, uy);
        gather4(at(16), shift_x, shift_y, any_displacement, kinds);
        gather4(at(32), fat_lx, fat_ly, fat_ux, fat_uy);
        kind = as_ints(kinds);
    }
};

// As least_gap in broad_phase.h.
CAROM_INLINE F8 least_gap(const Boxes& a, const Boxes& b)
{
    const auto along = [](F8 a_low, F8 a_high, F8 b_low, F8 b_high, F8 shift)
    { return greatest(b_low + least(shift, all(0)) - a_high, a_low + least(-shift, all(0)) - b_high); };
    const F8 x = along(a.lx, a.ux, b.lx, b.ux, b.shift_x - a.shift_x);
    const F8 y = along(a.ly, a.uy, b.ly, b.uy, b.shift_y - a.shift_y);
    return greatest(x, y) - (a.any_displacement + b.any_displacement);
}

void look_at_pairs(const BoxPair* eight, const SweptBox* places, float box_margin, SeenPairs& seen)
{
    const Boxes a(places, [&](int i) { return eight[i].a; });
    const Boxes b(places, [&](int i) { return eight[i].b; });
    // Plain items are neither triggers nor half-spaces, and lie in one of the two layers.
    constexpr std::uint32_t layer_bytes = 0xff;
    constexpr std::uint32_t trait_bytes = 0xffff00;
    const I8 kinds = a.kind | b.kind;
    const I8 plain = (kinds & all_ints(trait_bytes | 0x80)) == I8{};
    const I8 both_move = (kinds & all_ints(layer_bytes)) == I8{};
    const I8 one_moves = ((a.kind & all_ints(layer_bytes)) == I8{}) | ((b.kind & all_ints(layer_bytes)) == I8{});
    const I8 meet = (a.fat_lx <= b.fat_ux) & (a.fat_ux >= b.fat_lx) & (a.fat_ly <= b.fat_uy) & (a.fat_uy >= b.fat_ly);
    const I8 has_contact = lanes_from([&](int i) { return eight[i].contact; }) >= I8{};
    const I8 near = least_gap(a, b) <= select(both_move & ~has_contact, all(0.5f * box_margin), all(box_margin));
    seen.plain = bits(plain & one_moves);
    seen.near = bits(near);
    seen.meet = bits(meet);
    seen.stay = bits(plain & one_moves & meet & (near == has_contact));
}

// --- new overlaps -------------------------------------------------------------------------------------------------------------------------

struct Bounds
{
    float lx, ly, ux, uy;
};

CAROM_INLINE Bounds bounds_of(const BoxBlock& k, int i) { return {k.lx[i], k.ly[i], k.ux[i], k.uy[i]}; }

// Returns a bit for each box of the block that overlaps b.
CAROM_INLINE unsigned overlapping(const BoxBlock& k, const Bounds& b)
{
    static_assert(alignof(BoxBlock) == 32 && BoxBlock::size == lane_count);
    return bits((load(k.lx) <= all(b.ux)) & (load(k.ux) >= all(b.lx)) & (load(k.ly) <= all(b.uy)) &
                (load(k.uy) >= all(b.ly)));
}

// The bounds of the changed boxes of a block.
CAROM_INLINE Bounds around(const BoxBlock& k, unsigned changed)
{
    Bounds all = bounds_of(k, std::countr_zero(changed));
    for (unsigned lanes = changed & (changed - 1); lanes != 0; lanes &= lanes - 1)
    {
        const Bounds b = bounds_of(k, std::countr_zero(lanes));
        all = {b.lx < all.lx ? b.lx : all.lx, b.ly < all.ly ? b.ly : all.ly, b.ux > all.ux ? b.ux : all.ux,
               b.uy > all.uy ? b.uy : all.uy};
    }
    return all;
}

// New overlaps of boxes of block k, a bit of `near` for each, with boxes of block o. Of two boxes that have changed, the first in the tree finds the other.
CAROM_INLINE std::uint64_t new_between(const MovingBlocks& tree, std::int32_t k, std::int32_t o, unsigned near)
{
    const BlockPast& past = tree.past[o];
    std::uint64_t boxes = 0;
    for (; near != 0; near &= near - 1)
    {
        const int i = std::countr_zero(near);
        const unsigned later = o > k ? ~0u : o == k ? ~0u << (i + 1) : 0;
        const unsigned mine = (later | ~past.changed) & (o == k ? ~(1u << i) : ~0u);
        unsigned hits = mine & overlapping(tree.levels[0][o], bounds_of(tree.levels[0][k], i));
        if (hits != 0)
            hits &= ~overlapping(past.before, bounds_of(tree.past[k].before, i));
        boxes |= std::uint64_t{hits} << (i * lane_count);
    }
    return boxes;
}

// Descends the tree with all changed boxes of the block at once.
void new_overlaps(const MovingBlocks& tree, std::int32_t k, const OverlapSink& sink)
{
    const unsigned changed = tree.past[k].changed;
    if (changed == 0)
        return;
    const auto look_at = [&](std::int32_t o, unsigned near)
    {
        if (const std::uint64_t boxes = new_between(tree, k, o, near); boxes != 0)
            sink.note(sink.context, o, boxes);
    };
    const auto may_meet_below = [&](std::int32_t level, std::int32_t block)
    { return may_meet(tree.filters[0][k], tree.filters[level][block]); };
    if (!may_meet_below(tree.level_count - 1, 0))
        return;
    const BoxBlock& own = tree.levels[0][k];
    const Bounds all = around(own, changed);
    struct Entry
    {
        std::int32_t level;
        std::int32_t block;
    };
    Entry stack[BoxTree::arity * BoxTree::max_levels];
    int depth = 0;
    if (tree.level_count == 1)
        look_at(0, changed);
    else
        stack[depth++] = {tree.level_count - 1, 0};
    while (depth > 0)
    {
        const Entry e = stack[--depth];
        const BoxBlock& nodes = tree.levels[e.level][e.block];
        for (unsigned hits = overlapping(nodes, all); hits != 0; hits &= hits - 1)
        {
            const int i = std::countr_zero(hits);
            const std::int32_t node = e.block * lane_count + i;
            if (!may_meet_below(e.level - 1, node))
                continue;
            if (e.level > 1)
                stack[depth++] = {e.level - 1, node};
            else if (const unsigned near = changed & overlapping(own, bounds_of(nodes, i)); near != 0)
                look_at(node, near);
        }
    }
}

} // namespace pairs
