// Reports an impact to the user.

#include "core/grow.h"
#include "core/index.h"
#include "core/refuse.h"
#include "dynamics/continuous/impact/impact_set.h"
#include "dynamics/narrowphase/touch_tracker.h"
#include "dynamics/solver/effective_mass.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

// The effective mass of a body at the arm's end along the row's normal; 0 if it is infinite.
float point_mass(const ImpactBody& b, const ImpactRow& row, double turn, double arm_x, double arm_y)
{
    const ImpulseLine<double> line{row.nx, row.ny, turn};
    const double k = response(b.inverse(), line, line);
    return exceeds_rounding(k, (arm_x * arm_x + arm_y * arm_y) * b.inverse_inertia) ? static_cast<float>(1 / k) : 0;
}

// Impulses along parallel lines add up to one between their points.
double between(double a, double b, double part) { return a + part * (b - a); }

ContactVelocities between(const ContactVelocities& a, const ContactVelocities& b, double part)
{
    return {between(a.ax, b.ax, part), between(a.ay, b.ay, part), between(a.bx, b.bx, part), between(a.by, b.by, part)};
}

// The energy lost is the impulse times the mean of the velocities before and after: other impulses on the bodies meanwhile do work of their own.
double energy_lost(const Blow& blow, const ImpactRow& row)
{
    const double x = blow.normal * row.nx - blow.tangent * row.ny;
    const double y = blow.normal * row.ny + blow.tangent * row.nx;
    const ContactVelocities& v = blow.before;
    const ContactVelocities& u = blow.after;
    return -0.5 * (x * (v.bx - v.ax + u.bx - u.ax) + y * (v.by - v.ay + u.by - u.ay));
}

} // namespace

void ImpactSet::report_blows()
{
    for (std::size_t i = 0; i < m_blows.size(); ++i)
    {
        if (m_sources[static_cast<std::size_t>(m_blows[i].row)].own == none || m_blows[i].normal <= 0)
            continue;
        Strike strike = strike_of(m_blows[i]);
        if (i + 1 < m_blows.size() && are_one(m_blows[i], m_blows[i + 1]))
        {
            const Strike second = strike_of(m_blows[++i]);
            const double normal = strike.blow.normal + second.blow.normal;
            const double part = second.blow.normal / normal;
            strike.x = between(strike.x, second.x, part);
            strike.y = between(strike.y, second.y, part);
            strike.row.turn_a = between(strike.row.turn_a, second.row.turn_a, part);
            strike.row.turn_b = between(strike.row.turn_b, second.row.turn_b, part);
            strike.blow.approach = between(strike.blow.approach, second.blow.approach, part);
            strike.blow.before = between(strike.blow.before, second.blow.before, part);
            strike.blow.after = between(strike.blow.after, second.blow.after, part);
            strike.blow.normal = normal;
            strike.blow.tangent += second.blow.tangent;
        }
        if (!is_worth_reporting(strike.blow))
            continue;
        if (const ImpactEvent event = event_of(strike); is_finite(event.energy_lost) && is_finite(event.impulse))
            append(m_span.output.impacts, event);
        ++m_span.output.flight_impacts;
    }
}

ImpactSet::Strike ImpactSet::strike_of(const Blow& blow) const
{
    const auto i = static_cast<std::size_t>(blow.row);
    return {blow, m_rows[i], m_sources[i].touch.x, m_sources[i].touch.y};
}

bool ImpactSet::are_one(const Blow& first, const Blow& second) const
{
    const Source& s = m_sources[static_cast<std::size_t>(first.row)];
    const Source& t = m_sources[static_cast<std::size_t>(second.row)];
    const ImpactRow& p = m_rows[static_cast<std::size_t>(first.row)];
    const ImpactRow& q = m_rows[static_cast<std::size_t>(second.row)];
    constexpr double parallel = 1 - 1e-9;
    return first.round == second.round && s.own == t.own && s.other == t.other && second.normal > 0 &&
           p.nx * q.nx + p.ny * q.ny > parallel && first.restitution == second.restitution && first.kick == second.kick;
}

void ImpactSet::report_touch(std::size_t i)
{
    const ImpactRow& row = m_rows[i];
    const Source& s = m_sources[i];
    if (row.kind != ImpactRow::Kind::Contact || row.last_blow < 0)
        return;
    sum_impulse(row);
    if (s.contact != none && touches(m_state.contacts[s.contact]))
        return;
    const bool is_a = own_is_a(s);
    const auto sign = static_cast<float>(is_a ? -1 : 1);
    begin_touch_within_step(m_state, m_span.output,
                            {s.contact,
                             is_a ? s.own : s.other,
                             is_a ? s.other : s.own,
                             {m_origin.x + s.touch.x, m_origin.y + s.touch.y},
                             sign * Vec2{static_cast<float>(row.nx), static_cast<float>(row.ny)},
                             static_cast<float>(m_span.time_of_step(m_time))});
}

// For the reaction that a hinge reports.
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

// An approach slower than the speed that pressing gives in a sub-step is settling, and so are micro-collisions. An approach shallower than
// half a degree along a chain is rolling.
bool ImpactSet::is_worth_reporting(const Blow& blow) const
{
    const ImpactRow& row = m_rows[static_cast<std::size_t>(blow.row)];
    const Source& s = m_sources[static_cast<std::size_t>(blow.row)];
    const bool along_chain = m_state.shapes[s.other].owner != s.other;
    const double shallow = along_chain ? 0.01 * std::fabs(slide_of(row)) : 0;
    const double settling = s.rests ? 2 * hop_speed(s, std::max(-s.touch.acceleration, 0.0)) : 0;
    const double pressed = both_have_finite_mass(row) ? 2 * blow_of(s, s.touch.acceleration) : 0;
    return blow.approach > std::max({static_cast<double>(m_span.ctx.scene.tolerances.rest_speed), settling, pressed, shallow});
}

bool ImpactSet::own_is_a(const Source& s) const { return s.contact == none || m_state.contacts[s.contact].shape_a == s.own; }

ImpactEvent ImpactSet::event_of(const Strike& strike) const
{
    const Blow& blow = strike.blow;
    const ImpactRow& row = strike.row;
    const Source& s = m_sources[static_cast<std::size_t>(blow.row)];
    const bool is_a = own_is_a(s);
    const auto sign = static_cast<float>(is_a ? -1 : 1);
    auto e = event_between<ImpactEvent>(m_state, is_a ? s.own : s.other, is_a ? s.other : s.own);
    e.point = {m_origin.x + strike.x, m_origin.y + strike.y};
    e.normal = sign * Vec2{static_cast<float>(row.nx), static_cast<float>(row.ny)};
    e.time = static_cast<float>(m_span.time_of_step(m_time));
    e.impulse = static_cast<float>(blow.normal);
    e.friction_impulse = static_cast<float>(blow.tangent);
    e.energy_lost = static_cast<float>(energy_lost(blow, row));
    e.restitution = static_cast<float>(blow.restitution);
    e.friction = static_cast<float>(row.friction);
    e.kick_speed = static_cast<float>(blow.kick);
    e.effective_mass_a = point_mass(m_bodies[as_index(row.a)], row, row.turn_a, row.arm_a_x, row.arm_a_y);
    e.effective_mass_b = point_mass(m_bodies[as_index(row.b)], row, row.turn_b, row.arm_b_x, row.arm_b_y);
    const ContactVelocities& v = blow.before;
    const ContactVelocities& u = blow.after;
    e.velocity_a = {static_cast<float>(v.ax), static_cast<float>(v.ay)};
    e.velocity_b = {static_cast<float>(v.bx), static_cast<float>(v.by)};
    e.velocity_after_a = {static_cast<float>(u.ax), static_cast<float>(u.ay)};
    e.velocity_after_b = {static_cast<float>(u.bx), static_cast<float>(u.by)};
    if (is_a)
    {
        std::swap(e.effective_mass_a, e.effective_mass_b);
        std::swap(e.velocity_a, e.velocity_b);
        std::swap(e.velocity_after_a, e.velocity_after_b);
    }
    e.speed_a = dot(e.velocity_a, e.normal);
    e.speed_b = dot(e.velocity_b, e.normal);
    e.approach_speed = e.speed_a - e.speed_b;
    return e;
}

} // namespace carom::internal
