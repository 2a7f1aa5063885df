// Stage 4, islands: first the bodies that fly, the joint edges (joint_edges.cpp) and the islands (island_graph.cpp), then the arrays of all islands side by
// side (island_layout.cpp). Where no body or edge of the scene has changed, no body flies, and every island is large enough (IslandPolicy::caches_graph), the graph is reused (cached_graph.cpp), and so are
// constraints (cached_constraints.cpp) and hinges (WideKernels::follow_joints).

#include "dynamics/islands/island_graph.h"
#include "dynamics/islands/joint_edges.h"
#include "dynamics/islands/layout/cached_graph.h"
#include "dynamics/islands/layout/island_layout.h"
#include "dynamics/narrowphase/cached_constraints.h"
#include "dynamics/stages.h"

namespace carom::internal {

void build_islands(StepContext& ctx)
{
    Scratch& scratch = ctx.scratch;
    scratch.graph.fullest_cell = 0;
    if (scratch.reuse == Reuse::Constraints)
    {
        refill_islands(ctx);
        return;
    }
    list_fliers(ctx);
    gather_joints(ctx);
    if (graph_is_unchanged(ctx))
    {
        scratch.reuse = Reuse::Graph;
        refill_islands(ctx);
        cache_constraints(ctx);
        return;
    }
    scratch.cached_constraints.are_valid = false;
    build_island_graph(ctx);
    lay_out_islands(ctx);
    cache_graph(ctx);
}

} // namespace carom::internal
