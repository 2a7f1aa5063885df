#pragma once

// Properties of leaf types, in one table, so that code asks for a property and a new type cannot be forgotten.

#include "geometry/leaf.h"

#include <array>
#include <cstddef>

namespace carom::internal {

struct LeafTraits
{
    bool is_bounded = false;     ///< it has a box
    bool may_be_dynamic = false; ///< it may belong to a dynamic body
    bool has_corners = false;    ///< it is the hull of circles around a few points
    bool has_two_ends = false;   ///< these are the circles (p0, r0) and (p1, r1)
    bool has_edges = false;      ///< it has straight edges with normals
    bool is_line = false;        ///< it encloses nothing: either side of it is outside
    bool faces_all = true; ///< no points within a margin means apart; an arc, or a piece of a chain, may also face elsewhere
};

/// By LeafType.
inline constexpr std::array<LeafTraits, leaf_type_count> leaf_traits{{
    {},                                                                                                         // half-space
    {.is_bounded = true, .may_be_dynamic = true, .has_corners = true},                                          // circle
    {.is_bounded = true, .may_be_dynamic = true, .has_corners = true, .has_edges = true},                       // polygon
    {.is_bounded = true, .may_be_dynamic = true, .has_corners = true, .has_two_ends = true, .has_edges = true}, // capsule
    // segment
    {.is_bounded = true, .may_be_dynamic = true, .has_corners = true, .has_two_ends = true, .has_edges = true, .is_line = true},
    {.is_bounded = true, .is_line = true, .faces_all = false}, // arc
}};

[[nodiscard]] constexpr const LeafTraits& traits_of(const Leaf& leaf) { return leaf_traits[static_cast<std::size_t>(leaf.type)]; }

} // namespace carom::internal
