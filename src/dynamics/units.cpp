// Stage 4, units: first who flies, what joints hold (unit_links.cpp) and who is solved together (unit_graph.cpp), then all that each unit needs side by side
// (unit_layout.cpp). Where nothing has changed since the last step, and nothing flies, everyone stays in place (kept_units.cpp), and so do rows (kept_rows.cpp)
// and hinges (WideKernels::follow_joints).

#include "dynamics/kept_rows.h"
#include "dynamics/kept_units.h"
#include "dynamics/stages.h"
#include "dynamics/unit_graph.h"
#include "dynamics/unit_layout.h"
#include "dynamics/unit_links.h"

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
