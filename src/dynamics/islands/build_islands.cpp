// Stage 4, units: first who flies, what joints hold (joint_edges.cpp) and who is solved together (island_graph.cpp), then all that each unit needs side by side
// (island_layout.cpp). Where nothing has changed since the last step, and nothing flies, everyone stays in place (cached_graph.cpp), and so do rows (cached_constraints.cpp)
// and hinges (WideKernels::follow_joints).

#include "dynamics/islands/cached_graph.h"
#include "dynamics/islands/island_graph.h"
#include "dynamics/islands/island_layout.h"
#include "dynamics/islands/joint_edges.h"
#include "dynamics/narrowphase/cached_constraints.h"
#include "dynamics/stages.h"

namespace carom::internal {

void build_units(StepContext& ctx)
{
    ctx.scratch.fullest_cell = 0;
    if (ctx.scratch.kept_units.rows_stay)
    {
        refill_units(ctx);
        return;
    }
    list_fliers(ctx);
    gather_joints(ctx);
    ctx.scratch.kept_units.hinges_stay = units_stay(ctx);
    if (ctx.scratch.kept_units.hinges_stay)
    {
        refill_units(ctx);
        keep_rows(ctx);
        return;
    }
    ctx.scratch.kept_units.rows_apart = false;
    build_unit_graph(ctx);
    lay_out_units(ctx);
    keep_units(ctx);
}

} // namespace carom::internal
