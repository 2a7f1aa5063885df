// Contacts that still press after an impact become resting contacts: a force for the rest of the sub-step, if one body has infinite mass.

#include "dynamics/continuous/impact/impact_set.h"
#include "dynamics/continuous/resting_contact.h"
#include "dynamics/narrowphase/flush_pair.h"
#include "dynamics/state/body_store.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

constexpr double resting_turn = 0.05;            // rad: a resting contact is followed this far before it is renewed
constexpr double at_once = 0.002;                // of a sub-step
constexpr double at_once_held = 0.01;            // for resting contacts that existed before
constexpr double least_resting_time = 1.0 / 256; // of a sub-step

} // namespace

// All contacts that do not separate press together.
void ImpactSet::let_rest_what_presses(std::vector<std::int32_t>& changed)
{
    std::vector<ImpactBody> accelerations(m_bodies.size());
    for (std::size_t i = 0; i < m_members.size(); ++i)
    {
        if (m_members[i].flier == nullptr)
            continue;
        accelerations[i] = m_bodies[i];
        accelerations[i].vx = accelerations[i].vy = accelerations[i].w = 0;
    }
    std::vector<RestingForce> resting_forces;
    for (std::size_t i = 0; i < m_rows.size(); ++i)
    {
        if (m_rows[i].kind == ImpactRow::Kind::Bilateral || !has_stopped(i))
            continue;
        if (both_have_finite_mass(m_rows[i]))
            rest_on_each_other(m_rows[i], m_sources[i]);
        else
            resting_forces.push_back({static_cast<int>(i), gap_acceleration(i), slip_acceleration(i)});
    }
    press(accelerations, m_rows, resting_forces);
    for (Member& m : m_members)
    {
        if (m.flier != nullptr)
            m.flier->rests_until = 1e300;
    }
    for (const RestingForce& p : resting_forces)
    {
        if (p.force <= 0)
            continue;
        resting_contact(p);
        set_resting_time(static_cast<std::size_t>(p.row));
    }
    for (std::size_t i = 0; i < m_members.size(); ++i)
        accelerate(m_members[i], accelerations[i], changed);
}

// Friction on an arm may lift a resting body, and so may the curvature of a held body's path: if the pressing acceleration ends that at once,
// it is no hop.
bool ImpactSet::has_stopped(std::size_t i)
{
    const double rate = std::fabs(gap_rate(m_bodies, m_rows[i]));
    if (rate <= 2 * m_span.least_approach)
        return true;
    const Source& s = m_sources[i];
    const double part = was_resting(s.own, s.other) ? at_once_held : s.rests ? at_once : 0;
    return part > 0 && rate < -part * m_span.h * gap_acceleration(i);
}

bool ImpactSet::both_have_finite_mass(const ImpactRow& row) const
{
    const auto gives = [&](int member)
    {
        const int body = m_members[static_cast<std::size_t>(member)].body;
        return body != none && m_state.bodies[body].type == BodyType::Dynamic;
    };
    return row.kind == ImpactRow::Kind::Contact && gives(row.a) && gives(row.b);
}

// A force over time on two bodies that turn about each other would add energy: the solver takes over when the sub-step ends.
void ImpactSet::rest_on_each_other(const ImpactRow& row, const Source& s)
{
    if (!s.rests)
        return;
    for (const int member : {row.a, row.b})
    {
        if (Flier* f = m_members[static_cast<std::size_t>(member)].flier)
            f->rests = true;
    }
}

void ImpactSet::accelerate(Member& m, const ImpactBody& a, std::vector<std::int32_t>& changed) const
{
    if (m.flier == nullptr || (a.vx == 0 && a.vy == 0 && a.w == 0))
        return; // solver-owned bodies get their share when the resting contact ends
    if (!m.changed)
        changed.push_back(m.state);
    m.changed = true;
    m.flier->ax += a.vx;
    m.flier->ay += a.vy;
    m.flier->alpha += a.w;
}

// The acceleration that friction has to cancel: the slip, by the end of the sub-step, and the tangential acceleration.
double ImpactSet::slip_acceleration(std::size_t i) const
{
    const ImpactRow& r = m_rows[i];
    if (r.kind == ImpactRow::Kind::Limit)
        return 0;
    const auto along = [&](int member, double arm_x, double arm_y)
    {
        const Flier* f = m_members[static_cast<std::size_t>(member)].flier;
        if (f == nullptr)
            return 0.0;
        const double x = f->ax - f->alpha * arm_y - f->w * f->w * arm_x;
        const double y = f->ay + f->alpha * arm_x - f->w * f->w * arm_y;
        return y * r.nx - x * r.ny;
    };
    const double left = std::max(m_span.h - m_time, 1e-3 * m_span.h);
    return slip_rate(m_bodies, r) / left + along(r.b, r.arm_b_x, r.arm_b_y) - along(r.a, r.arm_a_x, r.arm_a_y);
}

// Acceleration of the gap on the present paths: the velocities have changed.
double ImpactSet::gap_acceleration(std::size_t i)
{
    const ImpactRow& row = m_rows[i];
    const Source& s = m_sources[i];
    if (row.kind == ImpactRow::Kind::Limit)
    {
        const Flier* f = m_members[static_cast<std::size_t>(row.a)].flier;
        return f != nullptr ? -row.turn_a * f->alpha : 0;
    }
    const FramePath other = path_from(m_span, m_members[static_cast<std::size_t>(row.a)].body, m_time, m_origin);
    const FramePath own = path_from(m_span, m_members[static_cast<std::size_t>(row.b)].body, m_time, m_origin);
    const LeafView own_leaf = leaf_view(m_state, s.own);
    const LeafView other_leaf = leaf_view(m_state, s.other);
    const double size = std::min(probe_size(own_leaf), probe_size(other_leaf));
    double g = 0;
    double nearest = 1e300;
    const FlushPair flush(m_state, s.other, s.own);
    for (const Touch& t : touches_now(other_leaf, other, own_leaf, own, 2 * still_rests * size, flush.flush()))
    {
        const double d = length_of(t.x - s.touch.x, t.y - s.touch.y);
        if (d < nearest)
        {
            nearest = d;
            g = t.acceleration;
        }
    }
    return g;
}

void ImpactSet::resting_contact(const RestingForce& p)
{
    const ImpactRow& row = m_rows[static_cast<std::size_t>(p.row)];
    const Source& s = m_sources[static_cast<std::size_t>(p.row)];
    Flier* a = m_members[static_cast<std::size_t>(row.a)].flier;
    Flier* b = m_members[static_cast<std::size_t>(row.b)].flier;
    for (Flier* f : {a, b})
    {
        if (f != nullptr)
            f->constrained = true;
    }
    if (row.kind == ImpactRow::Kind::Limit)
        return;
    const Vec2 point = to_vec2(m_origin) + Vec2{static_cast<float>(s.touch.x), static_cast<float>(s.touch.y)};
    RestingContact h{s.own,
                     s.other,
                     point,
                     {static_cast<float>(row.nx), static_cast<float>(row.ny)},
                     static_cast<float>(p.force),
                     static_cast<float>(p.friction),
                     m_time,
                     a == nullptr ? m_members[static_cast<std::size_t>(row.a)].state : none,
                     s.touch.probes.of_b,
                     s.touch.probes.of_a};
    if (b != nullptr)
        add_resting_contact(*b, h);
    std::swap(h.own, h.other);
    h.normal = -h.normal;
    std::swap(h.own_corners, h.other_corners);
    h.solved = b == nullptr ? m_members[static_cast<std::size_t>(row.b)].state : none;
    if (a != nullptr)
        add_resting_contact(*a, h);
}

void ImpactSet::add_resting_contact(Flier& f, const RestingContact& h) const
{
    const bool firm = m_state.bodies[m_state.shapes[h.other].body].type != BodyType::Dynamic;
    f.led = firm && (f.led || f.resting_count == 0);
    const BodySim& carrier_path = m_span.sim_of(m_state.shapes[h.other].body);
    const bool drifts =
        firm && m_state.bodies[m_state.shapes[h.other].body].type == BodyType::Kinematic && carrier_path.angular_velocity == 0;
    f.lead_x = drifts ? static_cast<double>(carrier_path.velocity.x) : 0;
    f.lead_y = drifts ? static_cast<double>(carrier_path.velocity.y) : 0;
    const bool conveys = m_state.shapes[h.other].surface_speed != 0 || m_state.shapes[h.own].surface_speed != 0;
    const bool moves = carrier_path.velocity != Vec2{} || carrier_path.angular_velocity != 0;
    const std::int32_t carrier = !firm || conveys ? none : moves ? m_state.shapes[h.other].body : carried_by_world;
    f.carrier = f.resting_count == 0 || f.carrier == carrier ? carrier : none;
    if (f.resting_count == Flier::most_resting)
        return;
    std::vector<RestingContacts>& sets = m_span.output.resting_sets;
    if (f.resting_set == none)
    {
        f.resting_set = static_cast<std::int32_t>(sets.size());
        sets.emplace_back();
    }
    sets[static_cast<std::size_t>(f.resting_set)][static_cast<std::size_t>(f.resting_count++)] = h;
}

// The time depends on all that turns: the curvature of the surface, the body that carries it, and the held body itself unless it is a ball.
void ImpactSet::set_resting_time(std::size_t i)
{
    const ImpactRow& row = m_rows[i];
    const Source& s = m_sources[i];
    if (row.kind != ImpactRow::Kind::Contact)
        return;
    const ImpactBody& a = m_bodies[static_cast<std::size_t>(row.a)];
    const ImpactBody& b = m_bodies[static_cast<std::size_t>(row.b)];
    const double bend = std::fabs(s.touch.curvature * slide_of(row));
    const double turn = bend + std::fabs(a.w) + (m_state.shapes[s.own].leaf.type == LeafType::Circle ? 0 : std::fabs(b.w));
    for (const int member : {row.a, row.b})
    {
        Flier* f = m_members[static_cast<std::size_t>(member)].flier;
        if (f == nullptr || turn == 0)
            continue;
        f->curvature_rate = std::max(f->curvature_rate, bend + std::fabs(a.w));
        f->rests_until = std::min(f->rests_until, m_time + std::max(resting_turn / turn, least_resting_time * m_span.h));
    }
}

} // namespace carom::internal
