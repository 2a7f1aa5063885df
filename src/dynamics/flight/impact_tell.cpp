// What the user hears of an impact.

#include "core/grow.h"
#include "dynamics/body_store.h"
#include "dynamics/contact_store.h"
#include "dynamics/flight/impact_set.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

void ImpactSet::tell(std::size_t i)
{
    const ImpactRow& row = m_rows[i];
    const Source& s = m_sources[i];
    if (row.kind != ImpactRow::Kind::Contact || row.approach == 0)
        return;
    sum_impulse(row);
    const bool own_is_a = s.contact == none || m_state.contacts[s.contact].shape_a == s.own;
    const ImpactEvent event = event_of(row, s, own_is_a);
    const std::int32_t shape_a = own_is_a ? s.own : s.other;
    const std::int32_t shape_b = own_is_a ? s.other : s.own;
    if (is_worth_telling(row, s))
    {
        append(m_span.output.impacts, event);
        ++m_span.output.flight_impacts;
    }
    const bool known = s.contact != none && (m_state.contacts[s.contact].flags & contact_flag::touching) != 0;
    if (known)
        return;
    append(m_span.output.begins, {s.contact, shape_a, shape_b, event.point, event.normal, event.time});
    if (s.contact != none)
        m_state.contacts[s.contact].flags |= contact_flag::touching | contact_flag::begun;
}

// For the force that a hinge reads back.
void ImpactSet::sum_impulse(const ImpactRow& r)
{
    const double px = r.normal * r.nx - r.tangent * r.ny;
    const double py = r.normal * r.ny + r.tangent * r.nx;
    if (Flier* f = m_members[static_cast<std::size_t>(r.b)].flier)
    {
        f->impulse_x += px;
        f->impulse_y += py;
        f->turn_impulse += r.arm_b_x * py - r.arm_b_y * px;
    }
    if (Flier* f = m_members[static_cast<std::size_t>(r.a)].flier)
    {
        f->impulse_x -= px;
        f->impulse_y -= py;
        f->turn_impulse -= r.arm_a_x * py - r.arm_a_y * px;
    }
}

// Slower than what presses the body on gives in a sub-step is settling, and so are the blows that pressing is taken in; shallower than half a degree
// along a chain is rolling.
bool ImpactSet::is_worth_telling(const ImpactRow& row, const Source& s) const
{
    const bool along_chain = m_state.shapes[s.other].owner != s.other;
    const double shallow = along_chain ? 0.01 * std::fabs(s.slide) : 0;
    const double blow = both_give_way(row) ? 2 * blow_of(s) : 0;
    return row.approach > std::max({static_cast<double>(m_span.ctx.scene.tolerances.rest_speed), -s.touch.acceleration * m_span.h,
                                    blow, shallow});
}

ImpactEvent ImpactSet::event_of(const ImpactRow& row, const Source& s, bool own_is_a) const
{
    const auto sign = static_cast<float>(own_is_a ? -1 : 1);
    auto e = event_between<ImpactEvent>(m_state, own_is_a ? s.own : s.other, own_is_a ? s.other : s.own);
    e.point = {m_origin.x + s.touch.x, m_origin.y + s.touch.y};
    e.normal = sign * Vec2{static_cast<float>(row.nx), static_cast<float>(row.ny)};
    e.time = static_cast<float>(m_span.time_of_step(m_time));
    e.approach_speed = static_cast<float>(row.approach);
    e.impulse = static_cast<float>(row.normal);
    e.friction_impulse = static_cast<float>(row.tangent);
    e.energy_lost = static_cast<float>(row.energy_lost);
    e.restitution = static_cast<float>(row.restitution);
    e.friction = static_cast<float>(row.friction);
    e.kick_speed = static_cast<float>(row.kick);
    const float speed_other = sign * static_cast<float>(s.speed_other);
    const float speed_own = sign * static_cast<float>(s.speed_other - row.approach);
    const float mass_other = point_mass(row.a, row, row.turn_a);
    const float mass_own = point_mass(row.b, row, row.turn_b);
    e.speed_a = own_is_a ? speed_own : speed_other;
    e.speed_b = own_is_a ? speed_other : speed_own;
    e.effective_mass_a = own_is_a ? mass_own : mass_other;
    e.effective_mass_b = own_is_a ? mass_other : mass_own;
    return e;
}

float ImpactSet::point_mass(int member, const ImpactRow& row, double turn) const
{
    const ImpactBody& b = m_bodies[static_cast<std::size_t>(member)];
    const double k = row.nx * row.nx * b.inverse_mass_x + row.ny * row.ny * b.inverse_mass_y + turn * turn * b.inverse_inertia;
    return k > 0 ? static_cast<float>(1 / k) : 0;
}

} // namespace carom::internal
