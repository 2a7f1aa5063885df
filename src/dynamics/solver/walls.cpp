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
    for (const std::span<const ContactRow> rows : {m_rows.rows, m_rows.late_rows, m_rows.pulled})
    {
        for (const ContactRow& row : rows)
            sum += row.core > 0 && is_jointed(row) ? entry(row) : 0;
    }
    return sum;
}

bool Walls::is_jointed(const ContactRow& row) const
{
    return ((m_view.states[row.a].flags | m_view.states[row.b].flags) & body_flag::jointed) != 0;
}

float Walls::entry(const ContactRow& row) const
{
    float most = 0;
    for (const RowPoint& p : std::span(row.points).first(as_index(row.count)))
    {
        const float now = row_separation(m_view, row, p);
        const float ahead = now + m_view.h * row_speed(m_view, row, p);
        most = std::max(most, std::min(now, 0.0f) - ahead);
    }
    return most;
}

void Walls::guard_cores() const
{
    // Between two walls neither is to push it through the other.
    float part = 1;
    for (int pass = 0; pass < guard_passes && guard_rows(part) > 1; ++pass)
        part = 0.5f;
    guard_wide_cores(0, static_cast<int>(m_rows.wide.size()));
}

void Walls::guard_wide_cores(int first, int last) const
{
    auto core = std::ranges::lower_bound(m_rows.cores, first * lane_count, {}, &WideCore::lane);
    for (; core != m_rows.cores.end() && core->lane < last * lane_count; ++core)
        guard_wide_core(*core);
}

void Walls::guard_wide_core(const WideCore& core) const
{
    const WideRow& row = m_rows.wide[as_index(core.lane / lane_count)];
    const int i = core.lane % lane_count;
    const bool a_gives = row.inverse_mass_a.v[i] != 0;
    if (!a_gives && row.inverse_mass_b.v[i] == 0)
        return;
    const BodyState& a = m_view.states[row.a.v[i]];
    const BodyState& b = m_view.states[row.b.v[i]];
    const Vec2 n{row.nx.v[i], row.ny.v[i]};
    const float centers = dot(b.delta_position - a.delta_position, n);
    float depth = 0;
    for (const WidePoint& p : std::span(row.points).first(as_index(core.points)))
    {
        const float separation =
            p.base.v[i] + centers + turned(b, p.along_b.v[i], p.across_b.v[i]) - turned(a, p.along_a.v[i], p.across_a.v[i]);
        depth = std::max(depth, -separation - core.depth);
    }
    if (depth > 0)
        push_out(a_gives ? row.a.v[i] : row.b.v[i], (a_gives ? -depth : depth) * n);
}

void Walls::push_out(std::int32_t state, Vec2 way) const
{
    BodyState& body = m_view.states[state];
    body.delta_position += way;
    body.flags |= body_flag::pressed;
}

// Says how many it found too deep.
int Walls::guard_rows(float part) const
{
    int too_deep = 0;
    for (const std::span<const ContactRow> rows : {m_rows.rows, m_rows.late_rows})
    {
        for (const ContactRow& row : rows)
            too_deep += row.core > 0 && row.count > 0 && guard_core(row, part) ? 1 : 0;
    }
    return too_deep;
}

bool Walls::guard_core(const ContactRow& row, float part) const
{
    float separation = row_separation(m_view, row, row.points[0]);
    if (row.count == 2)
        separation = std::min(separation, row_separation(m_view, row, row.points[1]));
    const float depth = -separation - row.core;
    if (depth <= 0)
        return false;
    const bool a_gives = m_view.constants[row.a].inverse_mass != Vec2{};
    push_out(a_gives ? row.a : row.b, part * (a_gives ? -depth : depth) * row.n);
    return true;
}

} // namespace carom::internal
