// In large islands without flight, the islands, colors and lanes depend on bodies, edges and joints alone. Subdivisions, soft joints and flight, which also
// depend on speeds, are for small islands. Where all inputs are unchanged, the layout of the last step is reused. The inputs are compared, not assumed, so that
// any change by the user shows there.

#include "dynamics/islands/layout/cached_graph.h"

#include "core/grow.h"
#include "dynamics/islands/island_graph.h"
#include "dynamics/solver/energy/island_energy.h"
#include "dynamics/state/scene_data.h"

#include <algorithm>

namespace carom::internal {

namespace {

// True if the layout of the island depends on edges alone.
bool is_plain(const Island& island)
{
    return island.policy.caches_graph && island.constraint_count == 0 && island.core_count == 0;
}

} // namespace

bool bodies_are_unchanged(const StepContext& ctx)
{
    const CachedGraph& kept = ctx.scratch.cached_graph;
    return std::equal(kept.bodies.begin(), kept.bodies.end(), ctx.state.awake_bodies.begin(), ctx.state.awake_bodies.end(),
                      [&](const CachedBody& k, std::int32_t body)
                      { return k.body == body && k.cell == ctx.state.bodies[body].plane_cell; });
}

bool graph_is_unchanged(const StepContext& ctx)
{
    const Scratch& scratch = ctx.scratch;
    const CachedGraph& kept = scratch.cached_graph;
    return kept.stay_plain && ctx.scene.law_count == 0 && !scratch.graph.has_uneven && scratch.graph.flying.empty() &&
           kept.edges_are_unchanged && (kept.joints_are_unchanged || kept.joints == scratch.graph.joint_edges);
}

void cache_graph(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    CachedGraph& kept = scratch.cached_graph;
    kept.are_plain = ctx.scene.law_count == 0 && !scratch.graph.has_uneven && scratch.layout.flier_seeds.empty() &&
                     std::all_of(scratch.solver.islands.begin(), scratch.solver.islands.end(), is_plain);
    if (!kept.are_plain)
        return;
    kept.bodies.clear();
    for (const std::int32_t body : ctx.state.awake_bodies)
        kept.bodies.push_back({body, ctx.state.bodies[body].plane_cell});
    set_size(kept.bound, scratch.solver.states.size());
    for (std::size_t s = 0; s < scratch.solver.states.size(); ++s)
        kept.bound[s] = (scratch.solver.states[s].flags & body_flag::unbound) == 0 ? 1 : 0;
}

} // namespace carom::internal
