// Stage 4, units: first who is solved together (unit_graph.cpp), then all that each unit needs side by side (unit_layout.cpp).

#include "dynamics/stages.h"
#include "dynamics/unit_graph.h"
#include "dynamics/unit_layout.h"

namespace carom::internal {

void build_units(StepContext& ctx)
{
    build_unit_graph(ctx);
    lay_out_units(ctx);
}

} // namespace carom::internal
