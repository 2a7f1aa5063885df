#pragma once

// Leaves that lie side by side, such as the tiles of a floor, have edges inside the surface that they make together. Where one of them is touched, the normal
// has to be one of the union's: an edge that a neighbor covers has none. The test uses the geometry at the moment of contact and stores nothing, so T
// junctions, gaps, overlaps, and tiles that come and go need no special cases.

#include "collision/manifold.h"

#include <array>
#include <span>

namespace carom::internal {

/// A leaf at rest relative to the touched leaf and flush with it; the pose is in the touched leaf's frame.
struct FlushNeighbour
{
    LeafView leaf{};
    RelativePose pose{};
};

/// Flush neighbors of one leaf, as a visitor meets them.
struct FlushNeighbours
{
    static constexpr int most = 16;

    std::array<FlushNeighbour, most> list;
    int count = 0;
    double tolerance = 0; ///< steps and gaps up to this size are ignored

    FlushNeighbours() {} // the list stays uninitialized: one is made for every search

    [[nodiscard]] std::span<const FlushNeighbour> all() const { return {list.data(), static_cast<std::size_t>(count)}; }
    void add(const LeafView& leaf, const RelativePose& pose)
    {
        if (count < most)
            list[static_cast<std::size_t>(count++)] = {leaf, pose};
    }
};

/// False where the manifold touches a leaf inside one of its faces, far from its ends. There, a neighbor covers the whole face, and the visitor
/// could not be so deep in it, or none of it. `of_a`: a is the touched leaf. A cheap test.
[[nodiscard]] bool may_be_hidden(const LeafView& touched, const RelativePose& pose, bool of_a, double tolerance,
                                 const LocalManifold& m);

/// True only where the leaf's surface is farther from a point of its frame than `reach`. Cheaper than the distance.
[[nodiscard]] bool is_farther(const LeafView& leaf, Vec2 point, double reach);

/// A point of the manifold on the surface of the touched leaf, in that leaf's frame.
[[nodiscard]] Vec2 touched_point(const LocalManifold& m, int i, bool of_a, const RelativePose& pose);

/// Whether the leaf can have flush neighbors, or be one. Circles and arcs cannot.
[[nodiscard]] bool may_be_flush(const Leaf& leaf);

enum class FlushVerdict : std::uint8_t
{
    Real,   ///< the union has this normal there
    Turned, ///< the union has another normal
    Hidden, ///< the contact belongs to a neighbor
};

struct FlushAnswer
{
    FlushVerdict verdict = FlushVerdict::Real;
    int edge = 0; ///< edge of the touched leaf, where the normal is turned
};

/// Whether the touched leaf may push the visitor along n at contact points of its surface. n and the points are in its own frame.
[[nodiscard]] FlushAnswer ask_flush(const LeafView& touched, const FlushNeighbours& neighbours, const LeafView& visitor,
                                    const RelativePose& pose, std::span<const Vec2> points, Vec2 n);

/// The outward normal of an edge, in the leaf's frame.
[[nodiscard]] Vec2 edge_normal(const LeafView& leaf, int edge);

/// Turns or empties a manifold of a and b according to the neighbors of either. True where it differs from the manifold of a and b alone.
bool keep_to_union(const LeafView& a, const FlushNeighbours& of_a, const LeafView& b, const FlushNeighbours& of_b,
                   const RelativePose& pose, float margin, LocalManifold& m);

} // namespace carom::internal
