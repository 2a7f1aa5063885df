#pragma once

// Boxes: in floats, rounded outwards, for the broad phase (conservative however far from the origin), and their arithmetic.

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

[[nodiscard]] constexpr bool overlaps(const FloatBox& a, const FloatBox& b)
{
    return (a.lx <= b.ux) & (b.lx <= a.ux) & (a.ly <= b.uy) & (b.ly <= a.uy);
}
[[nodiscard]] constexpr bool contains(const FloatBox& outer, const FloatBox& inner)
{
    return (outer.lx <= inner.lx) & (outer.ly <= inner.ly) & (inner.ux <= outer.ux) & (inner.uy <= outer.uy);
}
[[nodiscard]] constexpr FloatBox unite(const FloatBox& a, const FloatBox& b)
{
    return {a.lx < b.lx ? a.lx : b.lx, a.ly < b.ly ? a.ly : b.ly, a.ux > b.ux ? a.ux : b.ux, a.uy > b.uy ? a.uy : b.uy};
}

[[nodiscard]] FloatBox round_outwards(double lx, double ly, double ux, double uy);
[[nodiscard]] FloatBox round_outwards(const Box& box);
[[nodiscard]] FloatBox grow(const FloatBox& box, float margin);

/// Tight box of a leaf whose body's frame has this pose. A half-space gives an infinite one.
[[nodiscard]] Box leaf_bounds(const LeafView& view, const Pose& pose);

/// Largest distance of any point of the leaf from a point of the body's frame.
[[nodiscard]] float leaf_extent(const LeafView& view, Vec2 from);

} // namespace carom::internal
