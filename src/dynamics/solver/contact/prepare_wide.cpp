// Moves single contacts into lanes of wide contact constraints, and back.

#include "dynamics/solver/contact/prepare_wide.h"

#include "collision/edge_rules.h"
#include "core/index.h"
#include "dynamics/narrowphase/manifold_cache.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/solver/joint/joint_bodies.h"
#include "dynamics/solver/joint/joint_solver.h"
#include "dynamics/state/scene_data.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace carom::internal {

namespace {

struct Lane
{
    WideContact& constraint;
    WideContactNotes& notes;
    WideFeatures& features;
    int i;

    Lane(Scratch& scratch, std::int32_t lane)
        : constraint(scratch.solver.wide_contacts[as_index(lane / lane_count)]),
          notes(scratch.solver.wide_notes[as_index(lane / lane_count)]),
          features(scratch.solver.wide_features[as_index(lane / lane_count)]), i(lane % lane_count)
    {}

    // J M^-1 J^T of the normal, as in the kernels.
    [[nodiscard]] float k(const WidePoint& p) const
    {
        const float mass = constraint.inverse_mass_a.v[i] + constraint.inverse_mass_b.v[i];
        return mass + p.across_a.v[i] * p.across_a.v[i] * constraint.inverse_inertia_a.v[i] +
               p.across_b.v[i] * p.across_b.v[i] * constraint.inverse_inertia_b.v[i];
    }
};

const StateConstants& constants_of(const StepContext& ctx, std::int32_t state)
{
    return ctx.scratch.solver.constants[static_cast<std::size_t>(state)];
}

// True if the two points do not nearly coincide.
bool are_distinct(const Lane& lane)
{
    const float coupling = lane.constraint.coupling.v[lane.i];
    return coupling * coupling < 0.999f * (lane.k(lane.constraint.points[0]) * lane.k(lane.constraint.points[1]));
}

} // namespace

void fill_features(const SceneState& state, std::int32_t contact, WideFeatures& features, int i)
{
    static constexpr Contact nobody{};
    const Contact& of = contact == none ? nobody : state.contacts[contact];
    features.surface_speed.v[i] = of.surface_speed;
    features.rolling.v[i] = of.rolling_resistance > 0 ? rolling_length(state, of) : 0;
    features.rolling_impulse.v[i] = of.rolling_resistance > 0 ? of.manifold.rolling_impulse : 0;
}

void clear_sums(WideContact& constraint, WideContactNotes& notes)
{
    for (WidePoint& p : constraint.points)
    {
        p.total_impulse = {};
        p.total_tangent = {};
    }
    for (LaneFloats& approach : notes.approach)
        approach = {};
}

void refill_lane(const StepContext& ctx, std::size_t at, int i)
{
    SolverWorkspace& solver = ctx.scratch.solver;
    WideContact& constraint = solver.wide_contacts[at];
    WideContactNotes& notes = solver.wide_notes[at];
    for (std::uint32_t* lanes : {&notes.loaded, &notes.unreported, &notes.edge_of_b, &notes.nearest, &notes.cached})
        *lanes &= ~(1u << i);
    notes.followed = static_cast<std::uint16_t>(notes.followed & ~(1u << i));
    const std::int32_t index = notes.contact.v[i];
    const Contact& contact = ctx.state.contacts[index];
    const Manifold& m = contact.manifold;
    const StateConstants& a = constants_of(ctx, constraint.a.v[i]);
    const StateConstants& b = constants_of(ctx, constraint.b.v[i]);
    constraint.nx.v[i] = m.normal.x;
    constraint.ny.v[i] = m.normal.y;
    constraint.friction.v[i] = contact.friction;
    constraint.inverse_mass_a.v[i] = a.inverse_mass.x;
    constraint.inverse_mass_b.v[i] = b.inverse_mass.x;
    constraint.inverse_inertia_a.v[i] = a.inverse_inertia;
    constraint.inverse_inertia_b.v[i] = b.inverse_inertia;
    notes.count = static_cast<std::int8_t>(m.count);
    if (caches_edge_of_b(contact))
        notes.edge_of_b |= 1u << i;
    if (caches_nearest(contact))
        notes.nearest |= 1u << i;
    for (int k = 0; k < m.count; ++k)
    {
        const ManifoldPoint& from = m.points[k];
        WidePoint& p = constraint.points[k];
        p.across_a.v[i] = cross(from.anchor_a, m.normal);
        p.along_a.v[i] = dot(from.anchor_a, m.normal);
        p.across_b.v[i] = cross(from.anchor_b, m.normal);
        p.along_b.v[i] = dot(from.anchor_b, m.normal);
        p.base.v[i] = from.separation;
        p.normal_impulse.v[i] = impulses_of(ctx.state, index).points[k].normal;
        p.tangent_impulse.v[i] = impulses_of(ctx.state, index).points[k].tangent;
    }
    if (notes.featured != 0)
        fill_features(ctx.state, index, solver.wide_features[at], i);
    if ((contact.flags & contact_flag::loaded) != 0)
        notes.loaded |= 1u << i;
    if (!touches(contact))
        notes.unreported |= 1u << i;
    if (is_cached(contact))
        notes.cached |= 1u << i;
}

ContactConstraint constraint_of_lane(Scratch& scratch, std::int32_t index)
{
    const Lane lane(scratch, index);
    const int i = lane.i;
    ContactConstraint constraint;
    constraint.a = lane.constraint.a.v[i];
    constraint.b = lane.constraint.b.v[i];
    constraint.contact = lane.notes.contact.v[i];
    constraint.count = lane.notes.count;
    constraint.n = {lane.constraint.nx.v[i], lane.constraint.ny.v[i]};
    constraint.friction = lane.constraint.friction.v[i];
    if (lane.notes.featured != 0)
    {
        const float k = lane.constraint.inverse_inertia_a.v[i] + lane.constraint.inverse_inertia_b.v[i];
        constraint.surface_speed = lane.features.surface_speed.v[i];
        constraint.rolling = lane.features.rolling.v[i];
        constraint.rolling_impulse = lane.features.rolling_impulse.v[i];
        constraint.rolling_mass = k > 0 ? 1 / k : 0;
    }
    if (constraint.count == 2 && are_distinct(lane))
        constraint.coupling = lane.constraint.coupling.v[i];
    const auto arm = [&](float along, float across) { return along * constraint.n - across * perp(constraint.n); };
    for (int k = 0; k < constraint.count; ++k)
    {
        const WidePoint& from = lane.constraint.points[k];
        ConstraintPoint& p = constraint.points[k];
        p.ra = arm(from.along_a.v[i], from.across_a.v[i]);
        p.rb = arm(from.along_b.v[i], from.across_b.v[i]);
        const float k_normal = lane.k(from);
        p.normal_mass = k_normal > std::numeric_limits<float>::min() ? 1 / k_normal : 0;
        p.tangent_mass = from.tangent_mass.v[i];
        p.normal_impulse = from.normal_impulse.v[i];
        p.tangent_impulse = from.tangent_impulse.v[i];
        p.total_impulse = from.total_impulse.v[i];
        p.total_tangent = from.total_tangent.v[i];
        p.approach = lane.notes.approach[k].v[i];
    }
    return constraint;
}

void put_impulses(Scratch& scratch, const ContactConstraint& constraint, std::int32_t index)
{
    const Lane lane(scratch, index);
    for (int k = 0; k < constraint.count; ++k)
    {
        WidePoint& p = lane.constraint.points[k];
        p.normal_impulse.v[lane.i] = constraint.points[k].normal_impulse;
        p.tangent_impulse.v[lane.i] = constraint.points[k].tangent_impulse;
        p.total_impulse.v[lane.i] = constraint.points[k].total_impulse;
        p.total_tangent.v[lane.i] = constraint.points[k].total_tangent;
    }
}

std::uint32_t filled_lanes(const WideContactNotes& notes)
{
    std::uint32_t lanes = 0;
    for (int i = 0; i < lane_count; ++i)
        lanes |= notes.contact.v[i] != none ? 1u << i : 0;
    return lanes;
}

void drop_lane(const StepContext& ctx, Contact& contact, std::int32_t fixed)
{
    const Lane lane(ctx.scratch, contact.wide);
    WideContact& constraint = lane.constraint;
    WideContactNotes& notes = lane.notes;
    const int i = lane.i;
    for (PointImpulses& p : impulses_of(ctx.state, notes.contact.v[i]).points)
        p = {};
    constraint.a.v[i] = constraint.b.v[i] = fixed;
    notes.contact.v[i] = none;
    constraint.inverse_mass_a.v[i] = constraint.inverse_mass_b.v[i] = constraint.inverse_inertia_a.v[i] =
        constraint.inverse_inertia_b.v[i] = 0;
    constraint.coupling.v[i] = 0;
    fill_features(ctx.state, none, lane.features, i);
    for (WidePoint& p : constraint.points)
        p.base.v[i] = p.separation.v[i] = p.tangent_mass.v[i] = p.normal_impulse.v[i] = p.tangent_impulse.v[i] = 0;
    notes.loaded &= ~(1u << i);
    notes.may_hit |= may_hit_bit(i, 0) | may_hit_bit(i, 1);
    notes.unreported &= ~(1u << i);
    contact.wide = none;
    contact.flags &= ~contact_flag::loaded;
}

bool fits_joint_lane(const JointRecord& joint) { return joint.kind == JointType::Revolute && joint.limit_restitution == 0; }

} // namespace carom::internal
