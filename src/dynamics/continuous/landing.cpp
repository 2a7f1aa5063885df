// The end of a sub-step in flight: a flier that rests becomes solver-owned and gets constraints.

#include "dynamics/continuous/landing.h"

#include "dynamics/continuous/resting_contact.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/state/body_store.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/turns.h"

#include <cmath>
#include <span>

namespace carom::internal {

namespace {

// rad, turn of the path: beyond the first, a body would leave the surface within a sub-step before the solver notices; beyond the second,
// it would reach surfaces without a constraint in the rest of the step.
constexpr double most_curvature = 0.25;
constexpr double most_curvature_in_step = 1;

// True for a body held between two points of one shape, as a plank in a narrow bowl.
bool is_wedged(std::span<const RestingContact> holds)
{
    for (const RestingContact& a : holds)
    {
        for (const RestingContact& b : holds)
        {
            if (a.own == b.own && a.other == b.other && dot(a.normal, b.normal) < one_normal)
                return true;
        }
    }
    return false;
}

class Landing
{
public:
    Landing(const FlightSpan& span, const Flier& f) : m_span(span), m_flier(f) {}

    // Adds constraints for everything near the body.
    void run()
    {
        const BodyState& s = m_span.state_of(m_flier.state);
        const float turn = std::fabs(s.angular_velocity) * m_span.sim_of(m_flier.body).extent;
        const float margin = m_span.ctx.scene.tolerances.speculation + (length(s.velocity) + turn) * m_span.ctx.dt;
        const SceneState& state = m_span.state;
        for (const int index : contacts_of(state, m_flier.body))
        {
            const Contact& contact = state.contacts[index];
            if ((contact.flags & (contact_flag::trigger | contact_flag::passing)) == 0)
                add_constraint(index, margin);
        }
    }

private:
    void add_constraint(int index, float margin) const
    {
        const Contact& contact = m_span.state.contacts[index];
        const int body = other_body(contact, m_flier.body);
        const std::int32_t other = state_for_constraints(m_span.ctx, m_span.island, body);
        if (other == none || m_span.flier_at(other) != nullptr || has_constraint(index))
            return; // the other belongs to another island or still flies: the next step adds the contact edge
        const Manifold manifold = world_manifold(m_span.state, contact, pose_now(contact.body_a, other),
                                                 pose_now(contact.body_b, other), margin + motion_of(m_span.ctx, body));
        if (manifold.count == 0 && !may_come_to_face(contact, m_span.island))
            return;
        m_span.state.contacts[index].manifold = manifold; // the constraint refers to these points
        impulses_of(m_span.state, index) = {};
        m_span.state.contacts[index].flags &= ~contact_flag::cached;
        const bool flier_is_a = contact.body_a == m_flier.body;
        ContactConstraint constraint = prepare_constraint(m_span.ctx, index, manifold, flier_is_a ? m_flier.state : other,
                                                          flier_is_a ? other : m_flier.state);
        hand_over(contact, constraint);
        follow_closely(contact, m_span.island, constraint);
        m_span.state_of(other).flags &= ~body_flag::unbound;
        m_span.output.late_constraints.push_back(constraint);
    }

    // Impulses of resting contacts pass to the constraint, so that the body stays supported.
    void hand_over(const Contact& contact, ContactConstraint& constraint) const
    {
        const bool is_a = contact.body_a == m_flier.body;
        const std::int32_t own = is_a ? contact.shape_a : contact.shape_b;
        const std::int32_t other = is_a ? contact.shape_b : contact.shape_a;
        const BodyState& a = m_span.state_of(constraint.a);
        const Vec2 center = to_vec2(m_span.sim_of(contact.body_a).center + a.delta_position);
        for (const RestingContact& h : m_span.resting_contacts_of(m_flier))
        {
            if (h.own != own || h.other != other)
                continue;
            const auto distance = [&](const ConstraintPoint& p) { return length(center + p.ra - h.point); };
            ConstraintPoint& p =
                constraint.points[constraint.count == 2 && distance(constraint.points[1]) < distance(constraint.points[0])];
            p.normal_impulse += m_span.ctx.h * h.force;
            p.tangent_impulse += m_span.ctx.h * h.friction;
        }
    }

    [[nodiscard]] bool has_constraint(int contact) const
    {
        for (const ContactConstraint& constraint : m_span.output.late_constraints)
        {
            if (constraint.contact == contact && !is_dropped(constraint))
                return true;
        }
        return false;
    }

    [[nodiscard]] BodyPose pose_now(int body, std::int32_t other) const
    {
        const BodySim& sim = m_span.sim_of(body);
        const BodyState& s = m_span.state_of(body == m_flier.body ? m_flier.state : other);
        return {sim.center + s.delta_position, s.delta_rotation * sim.rotation, sim.local_center};
    }

    const FlightSpan& m_span;
    const Flier& m_flier;
};

void land(const FlightSpan& span, Flier& f)
{
    f.landed = true;
    span.output.disturbed = true;
    const Flier resting = f;
    release_resting_contacts(span, f, span.h);
    span.state_of(f.state).flags &= ~(body_flag::flier | body_flag::unbound);
    Landing(span, resting).run();
}

// m dv = reaction + contacts + m a h
void sum_reaction(const FlightSpan& span, Flier& f, const CenterMotion& center)
{
    const auto m = static_cast<double>(span.sim_of(f.body).mass);
    const Vec2 a = span.constants_of(f.state).acceleration;
    f.reaction += {static_cast<float>(m * (center.vx - f.start_vx - span.h * static_cast<double>(a.x)) - f.impulse_x),
                   static_cast<float>(m * (center.vy - f.start_vy - span.h * static_cast<double>(a.y)) - f.impulse_y)};
    if (f.lower > -1e200)
        f.limit_reaction += static_cast<float>(
            (f.w - f.start_w - span.h * turning_acceleration(span, f, f.angle)) / f.inverse_inertia - f.turn_impulse);
}

} // namespace

void finish_flight(const FlightSpan& span, Flier& f)
{
    if (f.landed)
        return;
    if (is_capped(span, f))
        f.time = span.h; // keeps pose and velocity: acceleration without displacement would create energy
    else
        advance(span, f, span.h);
    const CenterMotion center = center_of(f);
    BodyState& s = span.state_of(f.state);
    s.velocity = {static_cast<float>(center.vx), static_cast<float>(center.vy)};
    s.angular_velocity = static_cast<float>(f.w);
    s.delta_position = {static_cast<float>(center.x), static_cast<float>(center.y)};
    turn_from_start(s, f.angle);
    if (f.joint != none)
        sum_reaction(span, f, center);
    if (f.resting_count == 0 && !f.rests)
        return;
    const double left = static_cast<double>(span.ctx.dt) - span.time_of_step(span.h);
    // The other sides of a carrier that turns or moves come to meet the body: a subdivision is short, the rest of the sub-step is not.
    const bool goes_far = f.carrier != none && f.carrier != carried_by_world &&
                          span.ctx.subdivisions * span.h * speed_over_carrier(span, f) > 0.5 * f.size;
    const bool is_beyond_constraints = f.curvature_rate * span.h > most_curvature ||
                                       f.curvature_rate * left > most_curvature_in_step || goes_far ||
                                       is_wedged(span.resting_contacts_of(f));
    if (is_beyond_constraints || is_fast(span, f, center.vx, center.vy, f.w) || leaves_its_boxes(span, f))
        release_resting_contacts(span, f, span.h);
    else
        land(span, f);
}

} // namespace carom::internal
