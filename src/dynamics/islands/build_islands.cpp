// Stage 4, islands: first the bodies that fly, the joint edges (joint_edges.cpp) and the islands (island_graph.cpp), then the arrays of all islands side by
// side (island_layout.cpp). Where nothing has changed since the last step and nothing flies, the cached graph is reused (cached_graph.cpp), and so are
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
    ctx.scratch.graph.fullest_cell = 0;
    if (ctx.scratch.cached_graph.constraints_are_unchanged)
    {
        refill_islands(ctx);
        return;
    }
    list_fliers(ctx);
    gather_joints(ctx);
    ctx.scratch.cached_graph.hinges_are_unchanged = graph_is_unchanged(ctx);
    if (ctx.scratch.cached_graph.hinges_are_unchanged)
    {
        refill_islands(ctx);
        cache_constraints(ctx);
        return;
    }
    ctx.scratch.cached_graph.constraints_apart = false;
    build_island_graph(ctx);
    lay_out_islands(ctx);
    cache_graph(ctx);
}

} // namespace carom::internal
