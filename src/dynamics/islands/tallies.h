#pragma once

// Tallies of islands, counted while the graph is built.

#include "dynamics/step_context.h"

namespace carom::internal {

[[nodiscard]] inline IslandTally& tally(Scratch& scratch, std::int32_t island)
{
    return scratch.graph.tallies[static_cast<std::size_t>(island)];
}
/// Tally of the island of the body at an index in awake_bodies.
[[nodiscard]] inline IslandTally& tally_of(Scratch& scratch, std::int32_t place)
{
    return tally(scratch, scratch.graph.island_of[static_cast<std::size_t>(place)]);
}
/// Island of a contact edge or a joint edge. At least one of its bodies is dynamic.
template <class AnyEdge>
[[nodiscard]] std::int32_t island_of_edge(const Scratch& scratch, const AnyEdge& edge)
{
    return scratch.graph.island_of[static_cast<std::size_t>(edge.a >= 0 ? edge.a : edge.b)];
}

} // namespace carom::internal
