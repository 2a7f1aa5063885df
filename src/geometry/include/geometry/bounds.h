#pragma once

// Boxes and their arithmetic. The broad phase uses boxes in floats, rounded outwards: they are conservative however far from the origin.

#include "core/float4.h"
#include "geometry/leaf.h"

namespace carom::internal {

struct FloatBox
{
    float lx = 3e38f;
    float ly = 3e38f;
    float ux = -3e38f;
    float uy = -3e38f;
};

[[nodiscard]] inline bool overlaps(const FloatBox& a, const FloatBox& b)
{
    const F4 x = load4(&a.lx);
    const F4 y = load4(&b.lx);
    return bits(low_halves(x, y) <= high_halves(y, x)) == 15;
}
[[nodiscard]] inline bool contains(F4 outer, F4 inner)
{
    return bits(low_and_high(outer, inner) <= low_and_high(inner, outer)) == 15;
}
[[nodiscard]] inline bool contains(const FloatBox& outer, const FloatBox& inner)
{
    return contains(load4(&outer.lx), load4(&inner.lx));
}
[[nodiscard]] constexpr FloatBox unite(const FloatBox& a, const FloatBox& b)
{
    return {a.lx < b.lx ? a.lx : b.lx, a.ly < b.ly ? a.ly : b.ly, a.ux > b.ux ? a.ux : b.ux, a.uy > b.uy ? a.uy : b.uy};
}

[[nodiscard]] inline FloatBox box_of(F4 bounds)
{
    FloatBox box;
    store4(&box.lx, bounds);
    return box;
}

/// Rounds by the spacing of floats there, whether or not the conversion rounded: branch-free.
[[nodiscard]] inline F4 rounded_outwards(double lx, double ly, double ux, double uy)
{
    constexpr float spacing = 0x1p-23f;
    const F4 b = four_of(static_cast<float>(lx), static_cast<float>(ly), static_cast<float>(ux), static_cast<float>(uy));
    return b + four_of(-spacing, -spacing, spacing, spacing) * magnitude(b);
}
[[nodiscard]] inline FloatBox round_outwards(double lx, double ly, double ux, double uy)
{
    return box_of(rounded_outwards(lx, ly, ux, uy));
}
[[nodiscard]] inline FloatBox round_outwards(const Box& b) { return round_outwards(b.lower.x, b.lower.y, b.upper.x, b.upper.y); }
[[nodiscard]] inline F4 grown(F4 box, float m) { return box + four_of(-m, -m, m, m); }
[[nodiscard]] inline FloatBox grow(const FloatBox& b, float m) { return box_of(grown(load4(&b.lx), m)); }

/// Tight box of a leaf whose body's frame has this pose. A half-space gives an infinite one.
[[nodiscard]] Box leaf_bounds(const LeafView& view, const Pose& pose);

/// The same box in floats, rounded outwards: lx, ly, ux, uy.
[[nodiscard]] F4 outer_bounds(const LeafView& view, const Pose& pose);

/// Largest distance of any point of the leaf from a point of the body's frame.
[[nodiscard]] float leaf_extent(const LeafView& view, Vec2 from);

} // namespace carom::internal
