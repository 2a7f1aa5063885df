// An impact in flight. Gathered are all contacts that touch at this moment and hang together through bodies in flight; reflect.cpp gives
// their impulses; then they are told, and what is left pressing is held.
//
// Resting is an outcome: a bounce so small that the pressing acceleration would end it within half a sub-step (e u <= a_n h / 2) is none.
// Zero gravity never rests by that rule, nor does a slow body with room to bounce. What is held takes the part of the acceleration that
// presses, for the rest of the sub-step, and is then the solver's.

#include "dynamics/flight/impact.h"

#include "dynamics/body_store.h"
#include "dynamics/contact_store.h"
#include "dynamics/flight/hold.h"
#include "dynamics/flight/next_event.h"
#include "dynamics/flight/reflect.h"
#include "dynamics/joint_rows.h"
#include "dynamics/joint_solver.h"
#include "dynamics/material.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

constexpr double touching = 1e-6; // of the size: contacts this near take part
constexpr double still_held = 1e-3;
constexpr double hold_turn = 0.05; // rad: so far a hold is followed before it is looked at again
constexpr int crowd_limit = 8;     // impacts of a body in a sub-step

class ImpactSet
{
public:
    ImpactSet(const FlightSpan& span, Flier& first)
        : m_span(span), m_state(span.state), m_first(first), m_time(first.event_time), m_origin(span.sim_of(first.body).center)
    {}

    void run(std::vector<std::int32_t>& changed)
    {
        gather();
        note_before();
        reflect(m_bodies, m_rows, m_span.least_approach, [this](int row, double u) { return law(row, u); });
        for (std::size_t i = 0; i < m_members.size(); ++i)
            write_back(i, changed);
        for (std::size_t i = 0; i < m_rows.size(); ++i)
            tell(i);
        hold_what_presses(changed);
    }

private:
    struct Member
    {
        int body = none; ///< none: the world, as the other side of a limit
        std::int32_t state = none;
        Flier* flier = nullptr;
        FramePath path{};
        ImpactBody before{};
        bool changed = false;
    };

    /// Where a row comes from; none of the shapes: a limit of a hinge.
    struct Source
    {
        std::int32_t own = none; ///< on body b of the row
        std::int32_t other = none;
        std::int32_t contact = none;
        std::int32_t joint = none;
        Touch touch{};
        double slide = 0; ///< speed of the own center along perp(n) before
        double speed_other = 0;
        bool kicked = false;
        bool rests = false; ///< its bounce was none
    };

    // --- who takes part -------------------------------------------------------------------------------------------------------------

    void gather()
    {
        const int first = member_of(m_first.body);
        if (m_first.event_shape != none)
            add_touches(first, m_first.event_own, m_first.event_shape, contact_between(m_first.event_own, m_first.event_shape));
        for (std::size_t i = 0; i < m_members.size(); ++i)
            expand(static_cast<int>(i));
    }

    [[nodiscard]] std::int32_t contact_between(std::int32_t own, std::int32_t other) const
    {
        for (int edge = m_state.bodies[m_first.body].first_contact; edge != none;
             edge = m_state.contacts[edge >> 1].next[edge & 1])
        {
            const Contact& c = m_state.contacts[edge >> 1];
            if ((c.shape_a == own && c.shape_b == other) || (c.shape_b == own && c.shape_a == other))
                return edge >> 1;
        }
        return none;
    }

    int member_of(int body)
    {
        for (std::size_t i = 0; i < m_members.size(); ++i)
        {
            if (m_members[i].body == body)
                return static_cast<int>(i);
        }
        Member m;
        m.body = body;
        ImpactBody b;
        std::vector<Hold> released;
        if (body != none)
        {
            m.state = m_span.state_in_unit(body);
            m.flier = m_span.flier_at(m.state);
            if (m.flier != nullptr)
            {
                advance(m_span, *m.flier, m_time);
                released.assign(m.flier->held, m.flier->held + m.flier->held_count);
                release_holds(m_span, *m.flier, m_time);
                m.changed = !released.empty();
            }
            m.path = path_from(m_span, body, m_time, m_origin);
            b.vx = m.flier != nullptr ? m.flier->vx : m.path.center.vx;
            b.vy = m.flier != nullptr ? m.flier->vy : m.path.center.vy;
            b.w = m.flier != nullptr ? m.flier->w : m.path.w;
            set_masses(m, b);
        }
        m_members.push_back(m);
        m_bodies.push_back(b);
        const int index = static_cast<int>(m_members.size()) - 1;
        // What was held takes part: it is held anew, or let go on both sides.
        for (const Hold& h : released)
        {
            m_released.push_back(h);
            const auto other = static_cast<std::size_t>(member_of(m_state.shapes[h.other].body));
            m_members[other].changed = true;
            if (const Flier* f = m_members[other].flier)
            {
                m_bodies[other].vx = f->vx;
                m_bodies[other].vy = f->vy;
            }
        }
        return index;
    }

    void set_masses(const Member& m, ImpactBody& b) const
    {
        if (m_state.bodies[m.body].type != BodyType::Dynamic)
            return;
        if (m.flier != nullptr)
        {
            b.inverse_mass_x = m.flier->inverse_mass_x;
            b.inverse_mass_y = m.flier->inverse_mass_y;
            b.inverse_inertia = m.flier->inverse_inertia;
            return;
        }
        const BodySim& sim = m_span.sim_of(m.body);
        b.inverse_mass_x = sim.inverse_mass.x;
        b.inverse_mass_y = sim.inverse_mass.y;
        b.inverse_inertia = sim.inverse_inertia;
    }

    // All that touches the member, if its way is this unit's to say.
    void expand(int index)
    {
        const Member m = m_members[static_cast<std::size_t>(index)];
        if (m.body == none || m.state == none)
            return;
        add_limits(index);
        if (!m_span.unit.precise)
            return; // crowds hit two by two
        if (m.flier == nullptr)
            add_joints(m.body);
        for (int edge = m_state.bodies[m.body].first_contact; edge != none; edge = m_state.contacts[edge >> 1].next[edge & 1])
        {
            const Contact& contact = m_state.contacts[edge >> 1];
            if ((contact.flags & (contact_flag::trigger | contact_flag::passing)) != 0 || is_known(edge >> 1))
                continue;
            const bool is_a = contact.body_a == m.body;
            add_touches(index, is_a ? contact.shape_a : contact.shape_b, is_a ? contact.shape_b : contact.shape_a, edge >> 1);
        }
    }

    // What a joint holds it holds through an impact.
    void add_joints(int body)
    {
        for (int edge = m_state.bodies[body].first_joint; edge != none; edge = m_state.joints[edge >> 1].next[edge & 1])
        {
            const int index = edge >> 1;
            const auto is_it = [&](const Source& s) { return s.joint == index; };
            if (std::any_of(m_sources.begin(), m_sources.end(), is_it))
                continue;
            const JointRecord& joint = m_state.joints[index];
            const int a = member_of(joint.body_a);
            const int b = member_of(joint.body_b);
            const JointRows rows = holding_rows(joint, pose_of_joint(joint, a, b));
            for (int i = 0; i < rows.count; ++i)
            {
                const JointRow& r = rows.rows[i];
                ImpactRow row;
                row.kind = ImpactRow::Kind::Hold;
                row.a = a;
                row.b = b;
                row.nx = static_cast<double>(r.d.x);
                row.ny = static_cast<double>(r.d.y);
                row.turn_a = static_cast<double>(r.arm_a);
                row.turn_b = static_cast<double>(r.arm_b);
                m_rows.push_back(row);
                m_sources.push_back({.joint = index});
            }
        }
    }

    [[nodiscard]] JointPose pose_of_joint(const JointRecord& joint, int a, int b) const
    {
        const auto place = [&](int member, Vec2 anchor, Vec2& arm)
        {
            const Member& m = m_members[static_cast<std::size_t>(member)];
            if (m.body == none)
                return Position(anchor);
            const Rotation q{static_cast<float>(m.path.c), static_cast<float>(m.path.s)};
            arm = rotate(q, anchor - m.path.local_center);
            return Position{m_origin.x + m.path.center.x, m_origin.y + m.path.center.y} + arm;
        };
        JointPose pose;
        const Position pa = place(a, joint.anchor_a, pose.ra);
        const Position pb = place(b, joint.anchor_b, pose.rb);
        pose.gap = pb - pa;
        const FramePath& frame = m_members[static_cast<std::size_t>(a)].path;
        pose.axis = rotate(Rotation{static_cast<float>(frame.c), static_cast<float>(frame.s)}, joint.axis_a);
        return pose;
    }

    [[nodiscard]] bool is_known(int contact) const
    {
        return std::any_of(m_sources.begin(), m_sources.end(),
                           [&](const Source& s) { return s.contact == contact && s.own != none; });
    }

    void add_touches(int member, std::int32_t own, std::int32_t other, std::int32_t contact)
    {
        const LeafView own_leaf = leaf_view(m_state, own);
        const LeafView other_leaf = leaf_view(m_state, other);
        const int other_body = m_state.shapes[other].body;
        const double size = std::min(probe_size(own_leaf), probe_size(other_leaf));
        const FramePath other_path = path_from(m_span, other_body, m_time, m_origin);
        const Touches touches = touches_now(other_leaf, other_path, own_leaf, m_members[static_cast<std::size_t>(member)].path,
                                            nearness(member, own, other, other_body) * size);
        for (const Touch& t : touches)
        {
            if (lets_pass(m_span.ctx.scene, other, own, {static_cast<float>(t.nx), static_cast<float>(t.ny)}))
                continue;
            const int a = member_of(other_body);
            m_rows.push_back(row_of(t, a, member));
            m_sources.push_back({.own = own, .other = other, .contact = contact, .touch = t});
            ImpactRow& row = m_rows.back();
            row.friction = contact != none ? m_state.contacts[contact].friction : mixed_friction(m_span.ctx.scene, own, other);
            row.surface_speed =
                static_cast<double>(m_state.shapes[own].surface_speed) + static_cast<double>(m_state.shapes[other].surface_speed);
        }
    }

    // What was held or is in the solver's hands touches with its overlap or gap.
    [[nodiscard]] double nearness(int member, std::int32_t own, std::int32_t other, int other_body) const
    {
        const auto is_it = [&](const Hold& h)
        { return (h.own == own && h.other == other) || (h.own == other && h.other == own); };
        const bool solved = m_members[static_cast<std::size_t>(member)].flier == nullptr &&
                            m_span.flier_at(m_span.state_in_unit(other_body)) == nullptr;
        return solved || std::any_of(m_released.begin(), m_released.end(), is_it) ? still_held : touching;
    }

    [[nodiscard]] ImpactRow row_of(const Touch& t, int a, int b) const
    {
        const CenterPath& ca = m_members[static_cast<std::size_t>(a)].path.center;
        const CenterPath& cb = m_members[static_cast<std::size_t>(b)].path.center;
        ImpactRow row;
        row.a = a;
        row.b = b;
        row.nx = t.nx;
        row.ny = t.ny;
        row.arm_a_x = t.x - ca.x;
        row.arm_a_y = t.y - ca.y;
        row.arm_b_x = t.x - cb.x;
        row.arm_b_y = t.y - cb.y;
        row.turn_a = row.arm_a_x * t.ny - row.arm_a_y * t.nx;
        row.turn_b = row.arm_b_x * t.ny - row.arm_b_y * t.nx;
        return row;
    }

    // The gap of a limit is angle - lower or upper - angle.
    void add_limits(int index)
    {
        const Member m = m_members[static_cast<std::size_t>(index)];
        bool low = false;
        bool high = false;
        if (m.flier != nullptr && m.flier->joint != none)
        {
            low = m.flier->angle <= m.flier->lower + at_limit;
            high = m.flier->angle >= m.flier->upper - at_limit;
        }
        else if (m.state != none)
        {
            low = (m_span.state_of(m.state).flags & body_flag::at_lower) != 0;
            high = (m_span.state_of(m.state).flags & body_flag::at_upper) != 0;
        }
        if (low)
            add_limit(index, -1);
        if (high)
            add_limit(index, 1);
    }

    void add_limit(int index, double turn)
    {
        ImpactRow row;
        row.a = index;
        row.b = member_of(none);
        row.kind = ImpactRow::Kind::Limit;
        row.turn_a = turn;
        m_rows.push_back(row);
        m_sources.push_back({.touch = {.acceleration = -turn * m_members[static_cast<std::size_t>(index)].path.alpha}});
    }

    // --- what they do ---------------------------------------------------------------------------------------------------------------

    void note_before()
    {
        for (std::size_t i = 0; i < m_members.size(); ++i)
            m_members[i].before = m_bodies[i];
        for (std::size_t i = 0; i < m_rows.size(); ++i)
        {
            const ImpactRow& r = m_rows[i];
            const ImpactBody& a = m_bodies[static_cast<std::size_t>(r.a)];
            const ImpactBody& b = m_bodies[static_cast<std::size_t>(r.b)];
            const double ax = a.vx - a.w * r.arm_a_y;
            const double ay = a.vy + a.w * r.arm_a_x;
            m_sources[i].speed_other = ax * r.nx + ay * r.ny;
            m_sources[i].slide = (b.vx - ax) * -r.ny + (b.vy - ay) * r.nx;
        }
    }

    Bounce law(int index, double u)
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
        const double rest = std::max(-0.5 * s.touch.acceleration * m_span.h, 0.0) + m_span.least_approach;
        if (bounce.kick == 0 && (bounce.restitution * u <= rest || is_crowded(row)))
        {
            bounce.restitution = 0;
            s.rests = true;
        }
        return bounce;
    }

    // Bodies that go on striking each other, as in a heap that collapses, come to rest against each other.
    [[nodiscard]] bool is_crowded(const ImpactRow& row) const
    {
        const Member& a = m_members[static_cast<std::size_t>(row.a)];
        const Member& b = m_members[static_cast<std::size_t>(row.b)];
        return a.flier != nullptr && b.flier != nullptr && std::max(a.flier->impacts, b.flier->impacts) >= crowd_limit;
    }

    double kick(Source& s, float speed)
    {
        const KickResult result = kick_speed(m_span.ctx.scene, s.own, s.other, speed);
        s.kicked = result.a_fired || result.b_fired;
        if (result.a_fired)
            m_span.output.kicked_shapes.push_back(s.own);
        if (result.b_fired)
            m_span.output.kicked_shapes.push_back(s.other);
        return static_cast<double>(result.speed);
    }

    // --- back into the bodies -------------------------------------------------------------------------------------------------------

    void write_back(std::size_t i, std::vector<std::int32_t>& changed)
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
        else if (Flier* f = grounded(m); f != nullptr && is_fast(m_span, *f, now.vx, now.vy, now.w))
        {
            take_off(m_span, *f, m_time);
            m.flier = f;
            deflect(*f, now, struck);
        }
        else if (m.state != none)
            correct_state(m_span.state_of(m.state), m_span.h - m_time, dvx, dvy, dw);
        else
            defer(static_cast<int>(i));
        if (m.state != none)
            changed.push_back(m.state);
    }

    // What the solver has now but could fly.
    [[nodiscard]] Flier* grounded(const Member& m) const
    {
        const std::int32_t f = m.state == none ? none : m_span.scratch.flier_of_state[static_cast<std::size_t>(m.state)];
        return f == none ? nullptr : &m_span.scratch.fliers[static_cast<std::size_t>(f)];
    }

    void deflect(Flier& f, const ImpactBody& now, bool struck) const
    {
        f.vx = now.vx;
        f.vy = now.vy;
        f.w = now.w;
        f.alpha = turning_acceleration(m_span, f, f.angle);
        if (!struck)
            return;
        f.deflected = true;
        f.crowded |= !m_span.unit.precise || f.impacts >= crowd_limit;
        ++f.impacts;
        m_span.output.capped |= f.impacts >= impact_limit;
    }

    // Of another unit, or asleep: it takes effect at the end of the step.
    void defer(int index) const
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

    // --- telling --------------------------------------------------------------------------------------------------------------------

    void tell(std::size_t i)
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
            m_span.output.impacts.push_back({shape_a, shape_b, event});
            ++m_span.output.flight_impacts;
        }
        const bool known = s.contact != none && (m_state.contacts[s.contact].flags & contact_flag::touching) != 0;
        if (known)
            return;
        m_span.output.begins.push_back({s.contact, shape_a, shape_b, event.point, event.normal, event.time});
        if (s.contact != none)
            m_state.contacts[s.contact].flags |= contact_flag::touching | contact_flag::begun;
    }

    // For the force that a hinge reads back.
    void sum_impulse(const ImpactRow& r)
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

    // Slower than what presses the body on gives in a sub-step is settling; shallower than half a degree along a chain is rolling.
    [[nodiscard]] bool is_worth_telling(const ImpactRow& row, const Source& s) const
    {
        const bool along_chain = m_state.shapes[s.other].owner != s.other;
        const double shallow = along_chain ? 0.01 * std::fabs(s.slide) : 0;
        return row.approach >
               std::max({static_cast<double>(m_span.ctx.scene.tolerances.rest_speed), -s.touch.acceleration * m_span.h, shallow});
    }

    [[nodiscard]] ImpactEvent event_of(const ImpactRow& row, const Source& s, bool own_is_a) const
    {
        const auto sign = static_cast<float>(own_is_a ? -1 : 1);
        ImpactEvent e;
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

    [[nodiscard]] float point_mass(int member, const ImpactRow& row, double turn) const
    {
        const ImpactBody& b = m_bodies[static_cast<std::size_t>(member)];
        const double k =
            row.nx * row.nx * b.inverse_mass_x + row.ny * row.ny * b.inverse_mass_y + turn * turn * b.inverse_inertia;
        return k > 0 ? static_cast<float>(1 / k) : 0;
    }

    // --- holding --------------------------------------------------------------------------------------------------------------------

    // Contacts that no longer part press, on all bodies of this unit.
    void hold_what_presses(std::vector<std::int32_t>& changed)
    {
        std::vector<ImpactBody> accelerations(m_bodies.size());
        for (std::size_t i = 0; i < m_members.size(); ++i)
        {
            if (m_members[i].flier == nullptr)
                continue;
            accelerations[i] = m_bodies[i];
            accelerations[i].vx = accelerations[i].vy = accelerations[i].w = 0;
        }
        std::vector<Pressing> pressing;
        for (std::size_t i = 0; i < m_rows.size(); ++i)
        {
            if (m_rows[i].kind == ImpactRow::Kind::Hold || std::fabs(gap_rate(m_bodies, m_rows[i])) > 2 * m_span.least_approach)
                continue;
            if (both_give_way(m_rows[i]))
                rest_on_each_other(m_rows[i], m_sources[i]);
            else
                pressing.push_back({static_cast<int>(i), gap_acceleration(i), slip_acceleration(i)});
        }
        press(accelerations, m_rows, pressing);
        for (Member& m : m_members)
        {
            if (m.flier != nullptr)
                m.flier->hold_until = 1e300;
        }
        for (const Pressing& p : pressing)
        {
            if (p.force <= 0)
                continue;
            hold(p);
            set_hold_time(static_cast<std::size_t>(p.row));
        }
        for (std::size_t i = 0; i < m_members.size(); ++i)
            accelerate(m_members[i], accelerations[i], changed);
    }

    [[nodiscard]] bool both_give_way(const ImpactRow& row) const
    {
        const auto gives = [&](int member)
        {
            const int body = m_members[static_cast<std::size_t>(member)].body;
            return body != none && m_state.bodies[body].type == BodyType::Dynamic;
        };
        return row.kind == ImpactRow::Kind::Contact && gives(row.a) && gives(row.b);
    }

    // A force over a time on two that turn about each other would feed them energy: they are the solver's when the sub-step is over.
    void rest_on_each_other(const ImpactRow& row, const Source& s)
    {
        if (!s.rests)
            return;
        for (const int member : {row.a, row.b})
        {
            if (Flier* f = m_members[static_cast<std::size_t>(member)].flier)
                f->rests = true;
        }
    }

    void accelerate(Member& m, const ImpactBody& a, std::vector<std::int32_t>& changed) const
    {
        if (m.flier == nullptr || (a.vx == 0 && a.vy == 0 && a.w == 0))
            return; // the solver's bodies get their share when the hold ends
        if (!m.changed)
            changed.push_back(m.state);
        m.changed = true;
        m.flier->ax += a.vx;
        m.flier->ay += a.vy;
        m.flier->alpha += a.w;
    }

    // What friction has to make up for: the slip, by the end of the sub-step, and what accelerates it.
    [[nodiscard]] double slip_acceleration(std::size_t i) const
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

    // Of the paths as they are now: the velocities have changed.
    [[nodiscard]] double gap_acceleration(std::size_t i)
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
        for (const Touch& t : touches_now(other_leaf, other, own_leaf, own, 2 * still_held * size))
        {
            const double d = std::hypot(t.x - s.touch.x, t.y - s.touch.y);
            if (d < nearest)
            {
                nearest = d;
                g = t.acceleration;
            }
        }
        return g;
    }

    void hold(const Pressing& p)
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
        Hold h{s.own,
               s.other,
               point,
               {static_cast<float>(row.nx), static_cast<float>(row.ny)},
               static_cast<float>(p.force),
               static_cast<float>(p.friction),
               m_time,
               a == nullptr ? m_members[static_cast<std::size_t>(row.a)].state : none};
        if (b != nullptr)
            add_hold(*b, h);
        std::swap(h.own, h.other);
        h.normal = -h.normal;
        h.solved = b == nullptr ? m_members[static_cast<std::size_t>(row.b)].state : none;
        if (a != nullptr)
            add_hold(*a, h);
    }

    void add_hold(Flier& f, const Hold& h) const
    {
        const bool firm = m_state.bodies[m_state.shapes[h.other].body].type != BodyType::Dynamic;
        f.led = firm && (f.led || f.held_count == 0);
        const bool still = m_state.bodies[m_state.shapes[h.other].body].type == BodyType::Static &&
                           m_state.shapes[h.other].surface_speed == 0 && m_state.shapes[h.own].surface_speed == 0;
        f.on_still = still && (f.on_still || f.held_count == 0);
        if (f.held_count < Flier::most_held)
            f.held[f.held_count++] = h;
    }

    // Whatever turns under it: the bend of the surface, what carries the surface, and the body itself where it is no ball.
    void set_hold_time(std::size_t i)
    {
        const ImpactRow& row = m_rows[i];
        const Source& s = m_sources[i];
        if (row.kind != ImpactRow::Kind::Contact)
            return;
        const ImpactBody& a = m_bodies[static_cast<std::size_t>(row.a)];
        const ImpactBody& b = m_bodies[static_cast<std::size_t>(row.b)];
        const double turn = std::fabs(s.touch.curvature * s.slide) + std::fabs(a.w) +
                            (m_state.shapes[s.own].leaf.type == LeafType::Circle ? 0 : std::fabs(b.w));
        for (const int member : {row.a, row.b})
        {
            if (Flier* f = m_members[static_cast<std::size_t>(member)].flier; f != nullptr && turn > 0)
                f->hold_until = std::min(f->hold_until, m_time + hold_turn / turn);
        }
    }

    const FlightSpan& m_span;
    SceneState& m_state;
    Flier& m_first;
    double m_time;
    Position m_origin;
    std::vector<Hold> m_released{};
    std::vector<Member> m_members{}; ///< beside m_bodies
    std::vector<ImpactBody> m_bodies{};
    std::vector<Source> m_sources{}; ///< beside m_rows
    std::vector<ImpactRow> m_rows{};
};

} // namespace

void resolve_impact(const FlightSpan& span, Flier& first, std::vector<std::int32_t>& changed)
{
    ImpactSet(span, first).run(changed);
}

} // namespace carom::internal
