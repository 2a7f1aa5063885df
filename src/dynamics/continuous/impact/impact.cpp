// An impact in flight. All contacts that touch at this moment and are connected through bodies in flight are gathered; reflect.cpp computes
// their impulses. Then they are reported, and contacts that still press become resting contacts.
//
// Resting is an outcome: a bounce counts as none if it is low and so slow that the pressing acceleration would end it within half a sub-step
// (e u <= a_n h / 2). By that rule nothing rests in zero gravity, nor does a slow body with room to bounce. Between two bodies of finite mass
// that lean on each other, a bounce no faster than their micro-collisions is none either (MicroCollision). A resting contact takes the
// pressing part of the acceleration for the rest of the sub-step; then the solver takes over.

#include "dynamics/continuous/impact/impact.h"
#include "dynamics/continuous/flight.h"
#include "dynamics/continuous/impact/impact_set.h"
#include "dynamics/continuous/resting_contact.h"
#include "dynamics/narrowphase/material.h"
#include "dynamics/state/body_store.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

constexpr std::size_t work_of_an_impact = 50; // besides its rows: gathering, and the searches for the next events
constexpr int crowd_limit = 8;                // impacts per body in a sub-step
constexpr double deep_in = 0.002;             // of the size
constexpr double low_hop = 1e-3;              // of the size
constexpr double soon_turned = 0.5;           // rad
constexpr double lasting_restitution = 0.7;   // half of the energy or more comes back: hops are many

} // namespace

ImpactSet::ImpactSet(const FlightSpan& span, Flier& first)
    : m_span(span), m_state(span.state), m_first(first),
      m_renewed(first.resting_count > 0 && first.event_shape == none && first.event_time == first.rests_until),
      m_time(first.event_time), m_origin(span.sim_of(first.body).center)
{}

void ImpactSet::run(std::vector<std::int32_t>& changed)
{
    gather();
    ImpactWork& work = m_span.output.impact_work;
    const bool has_all_work = work.is_whole();
    work.spend(work_of_an_impact);
    bool is_jammed = !reflect(
        m_bodies, m_rows, m_span.least_approach, [this](int row, double u) { return law(row, u); }, work, m_blows,
        [this] { grow(); });
    if (is_jammed && (has_all_work || !work.is_spent()))
        is_jammed = !unite_jammed(); // the next sub-step would not get any further
    note_stopped_joints();
    for (std::size_t i = 0; i < m_members.size(); ++i)
        write_back(i, changed);
    for (std::size_t i = 0; i < m_rows.size(); ++i)
        report_touch(i);
    report_blows();
    let_rest_what_presses(changed);
    if (is_jammed)
        stop_until_next();
}

// Jammed bodies would strike each other again and again at the same moment.
void ImpactSet::stop_until_next()
{
    for (Member& m : m_members)
    {
        if (m.flier != nullptr)
            m.flier->impacts = m_span.most_impacts;
    }
    m_span.output.capped = true;
}

// Speed, before the impact, of the center of the row's second body along perp(n).
double ImpactSet::slide_of(const ImpactRow& row) const
{
    const ImpactBody& a = m_members[static_cast<std::size_t>(row.a)].before;
    const ImpactBody& b = m_members[static_cast<std::size_t>(row.b)].before;
    return (b.vx - a.vx + a.w * row.arm_a_y) * -row.ny + (b.vy - a.vy - a.w * row.arm_a_x) * row.nx;
}

Bounce ImpactSet::law(int index, double u)
{
    const ImpactRow& row = m_rows[static_cast<std::size_t>(index)];
    Source& s = m_sources[static_cast<std::size_t>(index)];
    Bounce bounce;
    if (row.kind == ImpactRow::Kind::Limit)
    {
        const Flier* f = m_members[static_cast<std::size_t>(row.a)].flier;
        bounce.restitution = f != nullptr ? static_cast<double>(m_state.joints[f->joint].limit_restitution) : 0;
    }
    else
    {
        const auto speed = static_cast<float>(u);
        bounce.restitution = mixed_restitution(m_span.ctx.scene, s.own, s.other, speed);
        if (!s.kicked)
            bounce.kick = kick(s, speed);
    }
    // Resting contacts elsewhere may press here.
    const bool parts = both_have_finite_mass(row) && bounce.restitution >= lasting_restitution;
    const double press = parts ? std::min(-s.touch.acceleration, steady_press(row)) : -s.touch.acceleration;
    const double resting_forces = std::max({press, press - gap_rate(m_resting, row), 0.0});
    const double rest = std::max({hop_speed(s, resting_forces), last_bounces(row, resting_forces, bounce.restitution),
                                  both_have_finite_mass(row) ? blow_of(s, -press) : 0}) +
                        m_span.least_approach;
    if (bounce.kick == 0 && (bounce.restitution * u <= rest || (is_crowded(row) && bounce.restitution < bouncing_restitution)))
    {
        s.rests = true;
        bounce.restitution = is_small_blow(row, s, u) ? 1 : 0;
    }
    s.bounces =
        !s.rests && row.kind == ImpactRow::Kind::Contact && (bounce.kick > 0 || bounce.restitution >= bouncing_restitution);
    return bounce;
}

// The part of the pressing acceleration that forces cause. Bodies that turn about each other's surface press as well, but where they bounce well they soon part.
double ImpactSet::steady_press(const ImpactRow& row) const
{
    const auto along_normal = [&](int member, double arm_x, double arm_y)
    {
        const FramePath& path = m_members[static_cast<std::size_t>(member)].path;
        return (path.center.ax - path.alpha * arm_y) * row.nx + (path.center.ay + path.alpha * arm_x) * row.ny;
    };
    return along_normal(row.a, row.arm_a_x, row.arm_a_y) - along_normal(row.b, row.arm_b_x, row.arm_b_y);
}

// A hop this slow counts as none: it is over within a sub-step, and low. The accelerations of a fast rotation do not last a sub-step.
double ImpactSet::hop_speed(const Source& s, double resting_forces) const
{
    const double within_time = 0.5 * resting_forces * m_span.h;
    const bool is_limit = s.own == none;
    return is_limit ? within_time : std::min(within_time, std::sqrt(2 * resting_forces * low_hop * size_of(s)));
}

// An impact this slow is the last: it and all lower bounces after it are over within a sub-step, before the bodies have turned to press
// elsewhere.
double ImpactSet::last_bounces(const ImpactRow& row, double resting_forces, double restitution) const
{
    const auto turning = [&](int member) { return std::fabs(m_members[static_cast<std::size_t>(member)].path.w); };
    const double time = std::min(m_span.h, soon_turned / std::max({turning(row.a), turning(row.b), 1e-300}));
    return 0.5 * resting_forces * time * (1 - restitution);
}

// Such bodies swing about each other's surface: if these micro-collisions took all speed, each would leave the bodies a little deeper.
bool ImpactSet::is_small_blow(const ImpactRow& row, const Source& s, double u) const
{
    return both_have_finite_mass(row) && s.touch.distance < -deep_in * size_of(s) && u < 2 * blow_of(s, s.touch.acceleration);
}

double ImpactSet::size_of(const Source& s) const
{
    return std::min(probe_size(leaf_view(m_state, s.own)), probe_size(leaf_view(m_state, s.other)));
}

// Speed that two bodies of finite mass may reach, when pressed together, before a micro-collision.
double ImpactSet::blow_of(const Source& s, double acceleration) const
{
    const MicroCollision press = m_span.press(m_state.shapes[s.own].body, m_state.shapes[s.other].body);
    return pressed_speed(acceleration, press, size_of(s));
}

// Bodies that strike each other again and again, as in a collapsing pile, come to rest against each other.
bool ImpactSet::is_crowded(const ImpactRow& row) const
{
    const Member& a = m_members[static_cast<std::size_t>(row.a)];
    const Member& b = m_members[static_cast<std::size_t>(row.b)];
    return a.flier != nullptr && b.flier != nullptr && std::max(a.flier->impacts, b.flier->impacts) >= crowd_limit;
}

double ImpactSet::kick(Source& s, float speed)
{
    const KickResult result = kick_speed(m_span.ctx.scene, s.own, s.other, speed);
    s.kicked = result.a_fired || result.b_fired;
    if (result.a_fired)
        m_span.output.kicked_shapes.push_back(s.own);
    if (result.b_fired)
        m_span.output.kicked_shapes.push_back(s.other);
    return static_cast<double>(result.speed);
}

void ImpactSet::note_stopped_joints()
{
    for (const ImpactRow& r : m_rows)
    {
        const std::int32_t a = m_members[static_cast<std::size_t>(r.a)].state;
        const std::int32_t b = m_members[static_cast<std::size_t>(r.b)].state;
        if (r.kind == ImpactRow::Kind::Bilateral && r.energy_lost != 0)
            m_span.output.stopped_joints.push_back({a != none ? a : b, r.energy_lost});
    }
}

void ImpactSet::write_back(std::size_t i, std::vector<std::int32_t>& changed)
{
    Member& m = m_members[i];
    const ImpactBody& now = m_bodies[i];
    const double dvx = now.vx - m.before.vx;
    const double dvy = now.vy - m.before.vy;
    const double dw = now.w - m.before.w;
    const bool struck = m.flier == &m_first || dvx != 0 || dvy != 0 || dw != 0;
    m.changed = m.changed || struck;
    if (!m.changed || m.body == none || (m.state == none && !struck))
        return;
    if (m.flier != nullptr)
        deflect(*m.flier, now, struck);
    else if (Flier* f = could_fly(m);
             f != nullptr && (is_fast(m_span, *f, now.vx, now.vy, now.w) || (struck && f->joint == none && leaves_bouncing(i))))
    {
        take_off(m_span, *f, m_time);
        m.flier = f;
        deflect(*f, now, struck);
    }
    else if (m.state != none)
    {
        correct_state(m_span, m.state, m_span.h - m_time, dvx, dvy, dw);
    }
    else
        defer(static_cast<int>(i));
    if (m.state != none)
        changed.push_back(m.state);
}

// Does a body bounce off that bears no load, and that the solver owns only because nothing was to meet it?
bool ImpactSet::leaves_bouncing(std::size_t member) const
{
    const auto place = static_cast<std::size_t>(m_state.bodies[m_members[member].body].awake_index);
    const GraphWorkspace& graph = m_span.scratch.graph;
    if (graph.flight_mode[place] != solver_owned || graph.is_loaded[place] != 0 ||
        bears_load_now(m_span, m_members[member].state))
        return false;
    for (std::size_t i = 0; i < m_rows.size(); ++i)
    {
        if (m_sources[i].bounces && (m_rows[i].a == static_cast<int>(member) || m_rows[i].b == static_cast<int>(member)))
            return true;
    }
    return false;
}

// The flier of a body that is solver-owned now, but could fly.
Flier* ImpactSet::could_fly(const Member& m) const
{
    const std::int32_t f = m.state == none ? none : m_span.scratch.flight.flier_of_state[static_cast<std::size_t>(m.state)];
    return f == none ? nullptr : &m_span.scratch.flight.fliers[static_cast<std::size_t>(f)];
}

void ImpactSet::deflect(Flier& f, const ImpactBody& now, bool struck) const
{
    f.vx = now.vx;
    f.vy = now.vy;
    f.w = now.w;
    f.alpha = turning_acceleration(m_span, f, f.angle);
    if (!struck)
        return;
    note_deflected(m_span.scratch, m_span.output, m_span.scratch.flight.flier_of_state[static_cast<std::size_t>(f.state)]);
    if (m_renewed)
        return;
    f.needs_wall_check = true;
    ++f.impacts;
    m_span.output.capped |= is_capped(m_span, f);
}

// For a body of another island, or asleep: the impulse takes effect at the end of the step.
void ImpactSet::defer(int index) const
{
    for (const ImpactRow& r : m_rows)
    {
        if (r.a != index)
            continue;
        const double px = -r.normal * r.nx + r.tangent * r.ny;
        const double py = -r.normal * r.ny - r.tangent * r.nx;
        m_span.output.deferred.push_back({m_members[static_cast<std::size_t>(index)].body,
                                          {static_cast<float>(px), static_cast<float>(py)},
                                          {static_cast<float>(r.arm_a_x), static_cast<float>(r.arm_a_y)},
                                          m_span.time_of_step(m_time)});
    }
}

void resolve_impact(const FlightSpan& span, Flier& first, std::vector<std::int32_t>& changed)
{
    ImpactSet(span, first).run(changed);
}

} // namespace carom::internal
