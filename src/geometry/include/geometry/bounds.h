#pragma once

// Boxes: in floats, rounded outwards, for the broad phase (conservative however far from the origin), and their arithmetic.

#include "core/float4.h"
#include "geometry/leaf.h"

#include <cmath>

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
    return bits(__builtin_shufflevector(x, y, 0, 1, 4, 5) <= __builtin_shufflevector(y, x, 2, 3, 6, 7)) == 15;
}
[[nodiscard]] constexpr bool contains(const FloatBox& outer, const FloatBox& inner)
{
    return (outer.lx <= inner.lx) & (outer.ly <= inner.ly) & (inner.ux <= outer.ux) & (inner.uy <= outer.uy);
}
[[nodiscard]] constexpr FloatBox unite(const FloatBox& a, const FloatBox& b)
{
    return {a.lx < b.lx ? a.lx : b.lx, a.ly < b.ly ? a.ly : b.ly, a.ux > b.ux ? a.ux : b.ux, a.uy > b.uy ? a.uy : b.uy};
}

/// By the spacing of floats there, whether the conversion rounded or not: no branches.
[[nodiscard]] inline FloatBox round_outwards(double lx, double ly, double ux, double uy)
{
    const auto down = [](double v)
    {
        const auto f = static_cast<float>(v);
        return f - 0x1p-23f * std::fabs(f);
    };
    return {down(lx), down(ly), -down(-ux), -down(-uy)};
}
[[nodiscard]] inline FloatBox round_outwards(const Box& b) { return round_outwards(b.lower.x, b.lower.y, b.upper.x, b.upper.y); }
[[nodiscard]] constexpr FloatBox grow(const FloatBox& b, float m) { return {b.lx - m, b.ly - m, b.ux + m, b.uy + m}; }

/// Tight box of a leaf whose body's frame has this pose. A half-space gives an infinite one.
[[nodiscard]] Box leaf_bounds(const LeafView& view, const Pose& pose);

/// Largest distance of any point of the leaf from a point of the body's frame.
[[nodiscard]] float leaf_extent(const LeafView& view, Vec2 from);

} // namespace carom::internal
