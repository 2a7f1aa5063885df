#pragma once

// Leaves that lie side by side, such as the tiles of a floor, have edges inside the surface that they make together. Where one of them is touched, the normal has
// to be one of the union's: an edge that a neighbour covers has none. The question is asked of the geometry at the moment of contact; nothing is stored, so T
// junctions, gaps, overlaps, and tiles that come and go need no care.

#include "collision/manifold.h"

#include <array>
#include <span>

namespace carom::internal {

/// Lies still beside the leaf that is touched; in its frame.
struct FlushNeighbour
{
    LeafView leaf{};
    RelativePose pose{};
};

/// Those of one leaf, as a visitor meets them.
struct FlushNeighbours
{
    static constexpr int most = 16;

    std::array<FlushNeighbour, most> list;
    int count = 0;
    double tolerance = 0; ///< steps and gaps up to here are none

    FlushNeighbours() {} // not filled: it is made for every search

    [[nodiscard]] std::span<const FlushNeighbour> all() const { return {list.data(), static_cast<std::size_t>(count)}; }
    void add(const LeafView& leaf, const RelativePose& pose)
    {
        if (count < most)
            list[static_cast<std::size_t>(count++)] = {leaf, pose};
    }
};

/// False where the manifold touches a leaf inside one of its faces, far from its ends: a neighbour covers either all of a face there, and the visitor
/// could not be so deep in it, or nothing. `of_a`: a is the leaf that is touched. Costs little.
[[nodiscard]] bool may_be_hidden(const LeafView& touched, const RelativePose& pose, bool of_a, double tolerance,
                                 const LocalManifold& m);

/// True only where the leaf's surface is farther from a point of its frame than the reach. Costs less than the distance.
[[nodiscard]] bool is_farther(const LeafView& leaf, Vec2 point, double reach);

/// A point of the manifold on the surface of the touched leaf, in that leaf's frame.
[[nodiscard]] Vec2 touched_point(const LocalManifold& m, int i, bool of_a, const RelativePose& pose);

/// Can the leaf have flush neighbours, or be one? Of circles and arcs nothing lies flush.
[[nodiscard]] bool may_be_flush(const Leaf& leaf);

enum class FlushVerdict : std::uint8_t
{
    Real,   ///< the union has this normal there
    Turned, ///< it has another one
    Hidden, ///< a neighbour has what is touched
};

struct FlushAnswer
{
    FlushVerdict verdict = FlushVerdict::Real;
    int edge = 0; ///< of the touched leaf, where the normal is turned
};

/// May the touched leaf push the visitor along n, in its own frame, at points of its surface that are in contact?
[[nodiscard]] FlushAnswer ask_flush(const LeafView& touched, const FlushNeighbours& neighbours, const LeafView& visitor,
                                    const RelativePose& pose, std::span<const Vec2> points, Vec2 n);

/// Outward, in the leaf's frame.
[[nodiscard]] Vec2 edge_normal(const LeafView& leaf, int edge);

/// Turns or empties a manifold of a and b by the neighbours of either. True where it is no longer what a and b alone have.
bool keep_to_union(const LeafView& a, const FlushNeighbours& of_a, const LeafView& b, const FlushNeighbours& of_b,
                   const RelativePose& pose, float margin, LocalManifold& m);

} // namespace carom::internal
