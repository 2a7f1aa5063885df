#pragma once

// Which leaves a query looks at.

#include "carom/query.h"
#include "core/refuse.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/scene_state.h"
#include "geometry/bounds.h"
#include "geometry/leaf.h"

#include <algorithm>
#include <variant>
#include <vector>

namespace carom::internal {

[[nodiscard]] inline bool passes(const SceneState& state, int shape, const QueryFilter& filter)
{
    const ShapeRecord& s = state.shapes[shape];
    return (filter.include_triggers || !s.trigger) && (s.filter.category & filter.mask) != 0 &&
           (filter.category & s.filter.mask) != 0 && (filter.without.is_null() || body_id(state, s.body) != filter.without) &&
           (!filter.accepts || filter.accepts(shape_id(state, shape)));
}

[[nodiscard]] inline Pose pose_of(const SceneState& state, int shape)
{
    return state.sims[static_cast<std::size_t>(state.shapes[shape].body)].pose();
}

/// Visits every leaf whose fat box passes the test, half-spaces included; visit returns false to stop.
template <class Test, class Visit>
void visit_leaves(const SceneState& state, const QueryFilter& filter, Test&& test, Visit&& visit)
{
    const auto filtered = [&](int shape) { return !passes(state, shape, filter) || visit(shape); };
    for (const std::int32_t shape : state.broad_phase.unbounded())
    {
        if (!filtered(shape))
            return;
    }
    if (state.broad_phase.descend(Layer::Moving, test, filtered))
        state.broad_phase.descend(Layer::Resting, test, filtered);
}

template <class Visit>
void visit_box(const SceneState& state, const QueryFilter& filter, const FloatBox& box, Visit&& visit)
{
    visit_leaves(state, filter, [&](const FloatBox& node) { return overlaps(node, box); }, visit);
}

/// Slab test of a box against a ray, conservative in floats.
struct RayBox
{
    double ox;
    double oy;
    double dx;
    double dy;
    double reach = 1; ///< fraction up to which the ray still matters

    bool operator()(const FloatBox& b) const
    {
        double low = 0;
        double high = reach;
        return clip(b.lx, b.ux, ox, dx, low, high) && clip(b.ly, b.uy, oy, dy, low, high);
    }
    static bool clip(double lower, double upper, double o, double d, double& low, double& high)
    {
        if (d == 0)
            return lower <= o && o <= upper;
        double t0 = (lower - o) / d;
        double t1 = (upper - o) / d;
        if (t0 > t1)
            std::swap(t0, t1);
        low = std::max(low, t0);
        high = std::min(high, t1);
        return low <= high + 1e-9;
    }
};

/// One hit a shape, the first of its pieces, in order.
template <class Hit, class Before>
[[nodiscard]] std::vector<Hit> first_of_each(std::vector<Hit> hits, const Before& before)
{
    std::sort(hits.begin(), hits.end(),
              [&](const Hit& a, const Hit& b) { return a.shape != b.shape ? a.shape < b.shape : before(a, b); });
    hits.erase(std::unique(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.shape == b.shape; }), hits.end());
    std::sort(hits.begin(), hits.end(), before);
    return hits;
}

/// False if the geometry is refused: a query's has to be bounded.
[[nodiscard]] inline bool normalize_bounded(const char* function, Geometry& geometry)
{
    return Checker{function}.holds(!std::holds_alternative<HalfSpace>(geometry), "geometry", "a half-space", "must be bounded") &&
           normalize_geometry(function, geometry);
}

} // namespace carom::internal
