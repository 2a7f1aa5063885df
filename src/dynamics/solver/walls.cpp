// Measures how deep bodies are in walls, and moves them back.

#include "dynamics/solver/walls.h"

#include "core/index.h"

#include <algorithm>

namespace carom::internal {

namespace {

constexpr int guard_passes = 8;

// n · (R r - r)
float turned(const BodyState& s, float along, float across)
{
    return (s.delta_rotation.c - 1) * along + s.delta_rotation.s * across;
}

} // namespace

float Walls::entry() const
{
    float sum = 0;
    for (const std::span<const ContactConstraint> constraints :
         {m_constraints.constraints, m_constraints.late_constraints, m_constraints.pulled})
    {
        for (const ContactConstraint& constraint : constraints)
            sum += constraint.core > 0 && is_jointed(constraint) ? entry(constraint) : 0;
    }
    return sum;
}

bool Walls::is_jointed(const ContactConstraint& constraint) const
{
    return ((m_view.states[constraint.a].flags | m_view.states[constraint.b].flags) & body_flag::jointed) != 0;
}

float Walls::entry(const ContactConstraint& constraint) const
{
    float most = 0;
    for (const ConstraintPoint& p : std::span(constraint.points).first(as_index(constraint.count)))
    {
        const float now = constraint_separation(m_view, constraint, p);
        const float ahead = now + m_view.h * constraint_speed(m_view, constraint, p);
        most = std::max(most, std::min(now, 0.0f) - ahead);
    }
    return most;
}

void Walls::guard_cores() const
{
    // Between two walls, neither may push the body through the other.
    float part = 1;
    for (int pass = 0; pass < guard_passes && guard_constraints(part) > 1; ++pass)
        part = 0.5f;
    guard_wide_cores(0, static_cast<int>(m_constraints.wide.size()));
}

void Walls::guard_wide_cores(int first, int last) const
{
    auto core = std::ranges::lower_bound(m_constraints.cores, first * lane_count, {}, &WideCore::lane);
    for (; core != m_constraints.cores.end() && core->lane < last * lane_count; ++core)
        guard_wide_core(*core);
}

void Walls::guard_wide_core(const WideCore& core) const
{
    const WideContact& constraint = m_constraints.wide[as_index(core.lane / lane_count)];
    const int i = core.lane % lane_count;
    const bool a_gives = constraint.inverse_mass_a.v[i] != 0;
    if (!a_gives && constraint.inverse_mass_b.v[i] == 0)
        return;
    const BodyState& a = m_view.states[constraint.a.v[i]];
    const BodyState& b = m_view.states[constraint.b.v[i]];
    const Vec2 n{constraint.nx.v[i], constraint.ny.v[i]};
    const float centers = dot(b.delta_position - a.delta_position, n);
    float depth = 0;
    for (const WidePoint& p : std::span(constraint.points).first(as_index(core.points)))
    {
        const float separation =
            p.base.v[i] + centers + turned(b, p.along_b.v[i], p.across_b.v[i]) - turned(a, p.along_a.v[i], p.across_a.v[i]);
        depth = std::max(depth, -separation - core.depth);
    }
    if (depth > 0)
        push_out(a_gives ? constraint.a.v[i] : constraint.b.v[i], (a_gives ? -depth : depth) * n);
}

void Walls::push_out(std::int32_t state, Vec2 displacement) const
{
    BodyState& body = m_view.states[state];
    body.delta_position += displacement;
    body.flags |= body_flag::pressed;
}

// Returns the number of contacts that are too deep.
int Walls::guard_constraints(float part) const
{
    int too_deep = 0;
    for (const std::span<const ContactConstraint> constraints : {m_constraints.constraints, m_constraints.late_constraints})
    {
        for (const ContactConstraint& constraint : constraints)
            too_deep += constraint.core > 0 && constraint.count > 0 && guard_core(constraint, part) ? 1 : 0;
    }
    return too_deep;
}

bool Walls::guard_core(const ContactConstraint& constraint, float part) const
{
    float separation = constraint_separation(m_view, constraint, constraint.points[0]);
    if (constraint.count == 2)
        separation = std::min(separation, constraint_separation(m_view, constraint, constraint.points[1]));
    const float depth = -separation - constraint.core;
    if (depth <= 0)
        return false;
    const bool a_gives = m_view.constants[constraint.a].inverse_mass != Vec2{};
    push_out(a_gives ? constraint.a : constraint.b, part * (a_gives ? -depth : depth) * constraint.n);
    return true;
}

} // namespace carom::internal
