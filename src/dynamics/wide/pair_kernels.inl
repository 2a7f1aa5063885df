// Which pairs of boxes stay as they are, eight at a time; fate_of in pairs.cpp has the same for one. Part of kernels.inl.

namespace pairs {

// Of eight items what decides about their pairs.
struct Boxes
{
    F8 lx, ly, ux, uy;                 ///< at the start of the step
    F8 shift_x, shift_y, any_way;      ///< their paths in it
    F8 fat_lx, fat_ly, fat_ux, fat_uy; ///< and the fat ones
    I8 kind;                           ///< layer and traits, a byte each

    template <class Item>
    CAROM_INLINE Boxes(const BoxPlace* places, const Item& item)
    {
        static_assert(offsetof(BoxPlace, path) == 0 && offsetof(BoxPath, box) == 0 && offsetof(BoxPath, shift) == 16 &&
                      offsetof(BoxPath, any_way) == 24 && offsetof(BoxPlace, layer) == 28 && offsetof(BoxPlace, traits) == 29 &&
                      offsetof(BoxPlace, box) == 32 && sizeof(Layer) == 1 && sizeof(ItemTraits) == 2);
        const auto at = [&](int offset)
        { return [&item, places, offset](int i) { return reinterpret_cast<const char*>(places + item(i)) + offset; }; };
        F8 kinds;
        gather4(at(0), lx, ly, ux, uy);
        gather4(at(16), shift_x, shift_y, any_way, kinds);
        gather4(at(32), fat_lx, fat_ly, fat_ux, fat_uy);
        std::memcpy(&kind, &kinds, sizeof kind);
    }
};

CAROM_INLINE I8 all_ints(std::int32_t x) { return I8{x, x, x, x, x, x, x, x}; }

// As least_gap.
CAROM_INLINE F8 least_gap(const Boxes& a, const Boxes& b)
{
    const auto along = [](F8 a_low, F8 a_high, F8 b_low, F8 b_high, F8 shift)
    { return greatest(b_low + least(shift, all(0)) - a_high, a_low + least(-shift, all(0)) - b_high); };
    const F8 x = along(a.lx, a.ux, b.lx, b.ux, b.shift_x - a.shift_x);
    const F8 y = along(a.ly, a.uy, b.ly, b.uy, b.shift_y - a.shift_y);
    return greatest(x, y) - (a.any_way + b.any_way);
}

std::uint32_t stay(const BoxPair* eight, const BoxPlace* places, float box_margin)
{
    const Boxes a(places, [&](int i) { return eight[i].a; });
    const Boxes b(places, [&](int i) { return eight[i].b; });
    LaneInts contacts;
    for (int i = 0; i < lane_count; ++i)
        contacts.v[i] = eight[i].contact;
    // Without triggers and half-spaces, in one layer or the other.
    constexpr std::int32_t layer_bytes = 0xff;
    constexpr std::int32_t trait_bytes = 0xffff00;
    const I8 kinds = a.kind | b.kind;
    const I8 plain = (kinds & all_ints(trait_bytes | 0x80)) == I8{};
    const I8 both_move = (kinds & all_ints(layer_bytes)) == I8{};
    const I8 one_moves = ((a.kind & all_ints(layer_bytes)) == I8{}) | ((b.kind & all_ints(layer_bytes)) == I8{});
    const I8 meet = (a.fat_lx <= b.fat_ux) & (a.fat_ux >= b.fat_lx) & (a.fat_ly <= b.fat_uy) & (a.fat_uy >= b.fat_ly);
    const I8 has_contact = load(contacts) >= I8{};
    const I8 near = least_gap(a, b) <= select(both_move & ~has_contact, all(0.5f * box_margin), all(box_margin));
    return bits(plain & one_moves & meet & (near == has_contact));
}

} // namespace pairs
