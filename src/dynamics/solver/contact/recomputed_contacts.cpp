// Recomputes manifolds within the step, and moves constraints over the seams of chains and arcs.

#include "dynamics/solver/contact/recomputed_contacts.h"

#include "core/index.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/state/coloring.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

constexpr float follow_turn = 0.0002f; // rad

// Each point takes over all of the old one that it matches; the impulses of others count in the sum over the step. Says which points are new.
std::array<bool, 2> carry_points(const Manifold& old, const Manifold& fresh, ContactConstraint& constraint)
{
    ConstraintPoint points[2];
    std::array<bool, 2> is_new{};
    bool taken[2] = {};
    const std::array<int, 2> from = match_points(old, fresh);
    for (int i = 0; i < fresh.count; ++i)
    {
        const int j = from[as_index(i)];
        is_new[as_index(i)] = j == none;
        if (j == none)
            continue;
        points[i] = constraint.points[j];
        taken[j] = true;
    }
    for (int j = 0; j < constraint.count; ++j)
    {
        if (taken[j])
            continue;
        points[0].total_impulse += constraint.points[j].total_impulse;
        points[0].total_tangent += constraint.points[j].total_tangent;
    }
    std::copy(std::begin(points), std::end(points), std::begin(constraint.points));
    return is_new;
}

} // namespace

void RecomputedContacts::add_constraints_beyond_seams()
{
    if (!m_work.island.policy.recomputes_contacts)
        return;
    const SceneState& state = m_work.ctx.state;
    for (std::int32_t s = m_work.island.first_state + 1; s <= m_work.island.first_state + m_work.island.dynamic_count; ++s)
    {
        if ((m_work.view.states[s].flags & body_flag::flier) != 0)
            continue;
        const int body = m_work.scratch.solver.state_bodies[static_cast<std::size_t>(s)];
        for (const int index : contacts_of(state, body))
            add_constraint_beyond_seam(index, body, s);
    }
}

void RecomputedContacts::add_constraint_beyond_seam(int index, int body, std::int32_t own)
{
    const Contact& contact = m_work.ctx.state.contacts[index];
    if (contact.manifold.count > 0 || is_left_out(contact) || !may_come_to_face(contact, m_work.island))
        return;
    const bool is_a = contact.body_a == body;
    const std::int32_t other = state_for_constraints(m_work.ctx, m_work.island, other_body(contact, body));
    const bool is_others_too = other != none && (m_work.view.states[other].flags & body_flag::dynamic) != 0;
    if (other == none || (is_others_too && !is_a))
        return;
    m_work.output.late_constraints.push_back(
        prepare_constraint(m_work.ctx, index, contact.manifold, is_a ? own : other, is_a ? other : own));
    follow_closely(contact, m_work.island, m_work.output.late_constraints.back());
}

void RecomputedContacts::predict_curvatures()
{
    m_work.for_each_constraint([this](ContactConstraint& constraint) { predict_curvature(constraint); });
}

void RecomputedContacts::predict_curvature(ContactConstraint& constraint) const
{
    if (constraint.followed != 0 && is_carried(constraint))
        predict_turn(constraint);
    if (constraint.refreshed == 0 || constraint.count != 1)
        return;
    ConstraintPoint& p = constraint.points[0];
    p.predicted_curvature = 0;
    const BodyState& a = m_work.view.states[constraint.a];
    const BodyState& b = m_work.view.states[constraint.b];
    const float now = constraint_separation(m_work.view, constraint, p);
    const float reach = m_work.ctx.h * (length(b.velocity - a.velocity) + std::fabs(a.angular_velocity) * length(p.ra));
    if (now > reach)
        return;
    const Manifold ahead = facing(constraint, m_work.ctx.h).manifold;
    if (ahead.count != 1 || dot(ahead.normal, constraint.n) < 0.5f)
        return;
    const Vec2 v = b.velocity + cross(b.angular_velocity, p.rb) - a.velocity - cross(a.angular_velocity, p.ra);
    p.predicted_curvature = ahead.points[0].separation - (now + m_work.ctx.h * dot(v, constraint.n));
}

// True if a turning kinematic body carries the contact.
bool RecomputedContacts::is_carried(const ContactConstraint& constraint) const
{
    const auto carries = [](const BodyState& s) { return (s.flags & body_flag::dynamic) == 0 && s.angular_velocity != 0; };
    return carries(m_work.view.states[constraint.a]) || carries(m_work.view.states[constraint.b]);
}

// The curvature for corners and edges, to second order in the rotation: points move on circles, while the face of a, or of b, turns.
void RecomputedContacts::predict_turn(ContactConstraint& constraint) const
{
    const BodyState& a = m_work.view.states[constraint.a];
    const BodyState& b = m_work.view.states[constraint.b];
    const float wa = a.angular_velocity;
    const float wb = b.angular_velocity;
    const float turning = 0.5f * m_work.ctx.h * m_work.ctx.h;
    for (int i = 0; i < constraint.count; ++i)
    {
        ConstraintPoint& p = constraint.points[i];
        const Vec2 v = b.velocity + cross(wb, p.rb) - a.velocity - cross(wa, p.ra);
        p.predicted_curvature = turning * (wa * wa * dot(constraint.n, p.ra) - wb * wb * dot(constraint.n, p.rb) +
                                           (wa + wb) * dot(perp(constraint.n), v));
    }
}

void RecomputedContacts::recompute()
{
    m_work.for_each_constraint([this](ContactConstraint& constraint)
                               { constraint.followed != 0 ? follow(constraint) : refresh_constraint(constraint); });
}

// Corners and edges of turned bodies face each other elsewhere; a contact that a turning body carries must not lag behind it.
void RecomputedContacts::follow(ContactConstraint& constraint)
{
    const BodyState& a = m_work.view.states[constraint.a];
    const BodyState& b = m_work.view.states[constraint.b];
    const float least = (is_carried(constraint) ? 0.1f : 1.0f) * follow_turn;
    if (constraint.count > 0 && !has_turned(constraint.turn_a, a.delta_rotation, least) &&
        !has_turned(constraint.turn_b, b.delta_rotation, least))
        return;
    Manifold fresh = manifold_of(constraint.contact, constraint, 0);
    const auto is_new = carry_points(m_work.ctx.state.contacts[constraint.contact].manifold, fresh, constraint);
    set_constraint_geometry(m_work.scratch, constraint, fresh);
    for (int i = 0; i < constraint.count; ++i)
    {
        if (is_new[as_index(i)])
            constraint.points[i].approach = approach_before(m_work.scratch, constraint, constraint.points[i]);
    }
    m_work.ctx.state.contacts[constraint.contact].manifold = fresh;
    impulses_of(m_work.ctx.state, constraint.contact) = {}; // the constraint holds them
}

bool RecomputedContacts::has_turned(Rotation from, Rotation to, float least)
{
    return std::fabs(to.s - from.s) + std::fabs(to.c - from.c) > least;
}

void RecomputedContacts::refresh_constraint(ContactConstraint& constraint)
{
    if (constraint.refreshed == 0)
        return;
    if (constraint.count == 0)
    {
        roll_back(constraint);
        return;
    }
    const Facing now = facing(constraint, 0);
    if (now.manifold.count != 1)
        return;
    if (now.contact != constraint.contact && has_constraint(now.contact))
    {
        constraint.count = 0; // rolled over to a piece that has its own constraint
        return;
    }
    set_constraint_geometry(m_work.scratch, constraint, now.manifold);
    if (now.contact == constraint.contact)
        return;
    leave_color(m_work.ctx.state, m_work.ctx.state.contacts[now.contact]);
    // Both contacts have the same bodies.
    m_work.ctx.state.contacts[now.contact].color = std::exchange(m_work.ctx.state.contacts[constraint.contact].color, none);
    forget_impulses(m_work.ctx.state, constraint.contact);
    constraint.contact = now.contact;
}

// Rolls back onto the piece that the shape left before.
void RecomputedContacts::roll_back(ContactConstraint& constraint)
{
    const Manifold now = manifold_of(constraint.contact, constraint, 0);
    if (now.count != 1)
        return;
    ConstraintPoint& p = constraint.points[0];
    p.normal_impulse = p.tangent_impulse = p.approach = 0;
    forget_loads(p);
    set_constraint_geometry(m_work.scratch, constraint, now);
}

bool RecomputedContacts::has_constraint(int contact)
{
    const auto is_it = [&](const ContactConstraint& constraint)
    { return constraint.contact == contact && !is_dropped(constraint); };
    return std::any_of(m_work.constraints.begin(), m_work.constraints.end(), is_it) ||
           std::any_of(m_work.output.late_constraints.begin(), m_work.output.late_constraints.end(), is_it);
}

Manifold RecomputedContacts::manifold_of(int index, const ContactConstraint& constraint, float ahead) const
{
    const Contact& contact = m_work.ctx.state.contacts[index];
    return world_manifold(m_work.ctx.state, contact, m_work.pose_of(contact.body_a, constraint.a, ahead),
                          m_work.pose_of(contact.body_b, constraint.b, ahead), 1e9f);
}

// The contact through which the constraint's shapes face each other now: a ball that rolls over a seam changes from piece to piece.
RecomputedContacts::Facing RecomputedContacts::facing(const ContactConstraint& constraint, float ahead) const
{
    const SceneState& state = m_work.ctx.state;
    Facing best{constraint.contact, manifold_of(constraint.contact, constraint, ahead)};
    const Contact& contact = state.contacts[constraint.contact];
    if (best.manifold.count == 1 || (contact.flags & contact_flag::piece) == 0)
        return best;
    const bool chain_is_a = state.shapes[contact.shape_a].owner != contact.shape_a;
    const int piece = chain_is_a ? contact.shape_a : contact.shape_b;
    const int visitor = chain_is_a ? contact.shape_b : contact.shape_a;
    for (const int index : contacts_of(state, state.shapes[visitor].body))
    {
        const Contact& other = state.contacts[index];
        const int other_piece = chain_is_a ? other.shape_a : other.shape_b;
        if ((chain_is_a ? other.shape_b : other.shape_a) != visitor ||
            state.shapes[other_piece].owner != state.shapes[piece].owner)
            continue;
        const Manifold m = manifold_of(index, constraint, ahead);
        if (m.count == 1 && (best.manifold.count != 1 || m.points[0].separation < best.manifold.points[0].separation))
            best = {index, m};
    }
    return best;
}

} // namespace carom::internal
