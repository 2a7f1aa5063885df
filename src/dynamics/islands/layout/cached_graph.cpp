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
bool goes_by_edges_alone(const Island& island)
{
    return island.policy.caches_graph && island.constraint_count == 0 && island.core_count == 0;
}

} // namespace

bool bodies_are_unchanged(const StepContext& ctx)
{
    const CachedGraph& cached = ctx.scratch.cached_graph;
    return std::equal(cached.bodies.begin(), cached.bodies.end(), ctx.state.awake_bodies.begin(), ctx.state.awake_bodies.end(),
                      [&](const CachedBody& k, std::int32_t body)
                      { return k.body == body && k.cell == ctx.state.bodies[body].plane_cell; });
}

bool graph_is_unchanged(const StepContext& ctx)
{
    const Scratch& scratch = ctx.scratch;
    const CachedGraph& cached = scratch.cached_graph;
    return cached.is_current && ctx.scene.law_count == 0 && !scratch.graph.has_uneven && scratch.graph.flying.empty() &&
           cached.edges_are_unchanged && (cached.joints_are_unchanged || cached.joints == scratch.graph.joint_edges);
}

void cache_graph(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    CachedGraph& cached = scratch.cached_graph;
    cached.is_valid = ctx.scene.law_count == 0 && !scratch.graph.has_uneven && scratch.layout.flier_seeds.empty() &&
                      std::all_of(scratch.solver.islands.begin(), scratch.solver.islands.end(), goes_by_edges_alone);
    if (!cached.is_valid)
        return;
    cached.bodies.clear();
    for (const std::int32_t body : ctx.state.awake_bodies)
        cached.bodies.push_back({body, ctx.state.bodies[body].plane_cell});
    set_size(cached.bound, scratch.solver.states.size());
    for (std::size_t s = 0; s < scratch.solver.states.size(); ++s)
        cached.bound[s] = (scratch.solver.states[s].flags & body_flag::unbound) == 0 ? 1 : 0;
}

} // namespace carom::internal
