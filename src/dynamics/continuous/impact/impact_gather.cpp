// Gathers the bodies and contacts of an impact, from the first touch through everything that touches at that moment.

#include "dynamics/continuous/impact/impact_set.h"
#include "dynamics/continuous/resting_contact.h"
#include "dynamics/narrowphase/flush_pair.h"
#include "dynamics/narrowphase/material.h"
#include "dynamics/solver/joint/joint_solver.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>

namespace carom::internal {

namespace {

constexpr double touching = 1e-6;        // of the size: contacts this near take part
constexpr std::size_t most_members = 16; // in a crowd: beyond it, the impulse goes on as the next impact of the same moment

} // namespace

void ImpactSet::gather()
{
    const int first = member_of(m_first.body);
    if (m_first.event_shape != none)
        add_touches(first, m_first.event_own, m_first.event_shape, contact_between(m_first.event_own, m_first.event_shape));
    m_members.front().is_struck = true;
}

// Before each round: the rows of all bodies that it may strike, and of those that a round has struck.
void ImpactSet::grow()
{
    for (std::size_t i = 0; i < m_rows.size(); ++i)
    {
        const ImpactRow& row = m_rows[i];
        if (row.kind == ImpactRow::Kind::Contact && gap_rate(m_bodies, row) < -m_span.least_approach)
            m_members[static_cast<std::size_t>(row.a)].is_struck = m_members[static_cast<std::size_t>(row.b)].is_struck = true;
    }
    for (std::size_t i = 0; i < m_members.size(); ++i)
    {
        if ((m_members[i].is_struck || m_members[i].changed) && !m_members[i].is_held)
            hold(static_cast<int>(i));
        if (!m_members[i].is_expanded && (i == 0 || m_members[i].changed || has_changed(i)))
            expand(static_cast<int>(i));
        for (; m_looked_at < m_released.size(); ++m_looked_at)
            look_again(m_released[m_looked_at]);
    }
}

bool ImpactSet::has_changed(std::size_t i) const
{
    const ImpactBody& now = m_bodies[i];
    const ImpactBody& before = m_members[i].before;
    return now.vx != before.vx || now.vy != before.vy || now.w != before.w;
}

// The contacts of a body that bears a load pass the blow on in the next sub-step.
bool ImpactSet::leaves_it_to_the_solver(const Member& m) const
{
    return m.flier == nullptr &&
           m_span.scratch.graph.is_loaded[static_cast<std::size_t>(m_state.bodies[m.body].awake_index)] != 0;
}

// A deflected body may rest against a shape with which it has no contact.
void ImpactSet::look_again(RestingContact h)
{
    const auto is_it = [&](const Source& s)
    { return (s.own == h.own && s.other == h.other) || (s.own == h.other && s.other == h.own); };
    if (!has_contact(m_state, h.own, h.other) && std::none_of(m_sources.begin(), m_sources.end(), is_it))
        add_touches(member_of(m_state.shapes[h.own].body), h.own, h.other, none);
}

std::int32_t ImpactSet::contact_between(std::int32_t own, std::int32_t other) const
{
    for (const int index : contacts_of(m_state, m_first.body))
    {
        const Contact& c = m_state.contacts[index];
        if ((c.shape_a == own && c.shape_b == other) || (c.shape_b == own && c.shape_a == other))
            return index;
    }
    return none;
}

int ImpactSet::member_of(int body)
{
    for (std::size_t i = 0; i < m_members.size(); ++i)
    {
        if (m_members[i].body == body)
            return static_cast<int>(i);
    }
    Member m;
    m.body = body;
    ImpactBody b;
    ImpactBody resting;
    std::vector<RestingContact> released;
    if (body != none)
    {
        m.state = m_span.state_in_island(body);
        m.flier = m_span.flier_at(m.state);
        if (m.flier != nullptr)
        {
            if (!is_capped(m_span, *m.flier))
                advance(m_span, *m.flier, m_time);
            released.assign(m_span.resting_contacts_of(*m.flier).begin(), m_span.resting_contacts_of(*m.flier).end());
            resting = {.vx = m.flier->ax, .vy = m.flier->ay, .w = m.flier->alpha};
            release_resting_contacts(m_span, *m.flier, m_time);
            resting = {.vx = resting.vx - m.flier->ax, .vy = resting.vy - m.flier->ay, .w = resting.w - m.flier->alpha};
            m.changed = !released.empty();
        }
        m.path = path_from(m_span, body, m_time, m_origin);
        b.vx = m.flier != nullptr ? m.flier->vx : m.path.center.vx;
        b.vy = m.flier != nullptr ? m.flier->vy : m.path.center.vy;
        b.w = m.flier != nullptr ? m.flier->w : m.path.w;
        set_masses(m, b);
    }
    m.before = b;
    m_members.push_back(m);
    m_bodies.push_back(b);
    m_resting.push_back(resting);
    const int index = static_cast<int>(m_members.size()) - 1;
    // The other bodies of released resting contacts take part: the contacts come to rest again, or are released on both sides.
    for (const RestingContact& h : released)
    {
        m_released.push_back(h);
        const auto other = static_cast<std::size_t>(member_of(m_state.shapes[h.other].body));
        m_members[other].changed = true;
        if (const Flier* f = m_members[other].flier)
        {
            m_bodies[other].vx = m_members[other].before.vx = f->vx;
            m_bodies[other].vy = m_members[other].before.vy = f->vy;
        }
    }
    return index;
}

void ImpactSet::set_masses(const Member& m, ImpactBody& b) const
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

// Limits and joints hold a member from the first round on.
void ImpactSet::hold(int index)
{
    m_members[static_cast<std::size_t>(index)].is_held = true;
    const Member m = m_members[static_cast<std::size_t>(index)];
    if (m.body == none || m.state == none)
        return;
    add_limits(index);
    if (m.flier == nullptr && (m_span.island.policy.exact_impacts || m_members.size() < most_members))
        add_joints(m.body);
}

// Adds everything that touches the member, if its path is computed in this island.
void ImpactSet::expand(int index)
{
    m_members[static_cast<std::size_t>(index)].is_expanded = true;
    const Member m = m_members[static_cast<std::size_t>(index)];
    if (m.body == none || m.state == none)
        return;
    if (!m_span.island.policy.exact_impacts && (m_members.size() >= most_members || leaves_it_to_the_solver(m)))
        return;
    for (const int other_index : contacts_of(m_state, m.body))
    {
        const Contact& contact = m_state.contacts[other_index];
        if ((contact.flags & (contact_flag::trigger | contact_flag::passing)) != 0 || is_known(other_index))
            continue;
        const bool is_a = contact.body_a == m.body;
        add_touches(index, is_a ? contact.shape_a : contact.shape_b, is_a ? contact.shape_b : contact.shape_a, other_index);
    }
}

// Joints keep their bilateral rows through an impact.
void ImpactSet::add_joints(int body)
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
        m_members[static_cast<std::size_t>(a)].is_struck = m_members[static_cast<std::size_t>(b)].is_struck = true;
        const JointRows rows = rows_at(joint, pose_of_joint(joint, a, b));
        for (const JointRow& r : rows.holds())
        {
            ImpactRow row;
            row.kind = ImpactRow::Kind::Bilateral;
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

JointPose ImpactSet::pose_of_joint(const JointRecord& joint, int a, int b) const
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

bool ImpactSet::is_known(int contact) const
{
    return std::any_of(m_sources.begin(), m_sources.end(),
                       [&](const Source& s) { return s.contact == contact && s.own != none; });
}

void ImpactSet::add_touches(int member, std::int32_t own, std::int32_t other, std::int32_t contact)
{
    const LeafView own_leaf = leaf_view(m_state, own);
    const LeafView other_leaf = leaf_view(m_state, other);
    const int other_body = m_state.shapes[other].body;
    const double size = std::min(probe_size(own_leaf), probe_size(other_leaf));
    const FramePath other_path = path_from(m_span, other_body, m_time, m_origin);
    const FramePath& own_path = m_members[static_cast<std::size_t>(member)].path;
    const double near = nearness(member, own, other, other_body) * size;
    if (are_apart(other_leaf, other_path, own_leaf, own_path, line_of_centers(other_path, own_path), near))
        return;
    const FlushPair flush(m_state, other, own);
    const Touches touches = touches_now(other_leaf, other_path, own_leaf, own_path, near, flush.flush());
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

// Released resting contacts and contacts of solver-owned bodies touch with their overlap or gap.
double ImpactSet::nearness(int member, std::int32_t own, std::int32_t other, int other_body) const
{
    const bool solved = m_members[static_cast<std::size_t>(member)].flier == nullptr &&
                        m_span.flier_at(m_span.state_in_island(other_body)) == nullptr;
    return solved || was_resting(own, other) ? still_rests : touching;
}

bool ImpactSet::was_resting(std::int32_t own, std::int32_t other) const
{
    return std::any_of(m_released.begin(), m_released.end(), [&](const RestingContact& h)
                       { return (h.own == own && h.other == other) || (h.own == other && h.other == own); });
}

ImpactRow ImpactSet::row_of(const Touch& t, int a, int b) const
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
void ImpactSet::add_limits(int index)
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

void ImpactSet::add_limit(int index, double turn)
{
    ImpactRow row;
    row.a = index;
    row.b = member_of(none);
    row.kind = ImpactRow::Kind::Limit;
    row.turn_a = turn;
    m_rows.push_back(row);
    m_sources.push_back({.touch = {.acceleration = -turn * m_members[static_cast<std::size_t>(index)].path.alpha}});
}

} // namespace carom::internal
