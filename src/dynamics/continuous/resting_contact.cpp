// Ends resting contacts in flight, and corrects bodies that the solver has already moved.

#include "dynamics/continuous/resting_contact.h"

#include "dynamics/state/turns.h"

namespace carom::internal {

void correct_state(const FlightSpan& span, std::int32_t state, double left, double dvx, double dvy, double dw)
{
    span.output.disturbed = true;
    span.output.struck_states.push_back(state);
    BodyState& s = span.state_of(state);
    const Vec2 dv = {static_cast<float>(dvx), static_cast<float>(dvy)};
    const auto time = static_cast<float>(left);
    s.velocity += dv;
    s.angular_velocity += static_cast<float>(dw);
    s.delta_position += time * dv;
    turn_by(s, time * static_cast<float>(dw));
}

namespace {

// The force acted from its start until `time`: equivalent to an impulse half way.
void push_back(const FlightSpan& span, const RestingContact& h, double time)
{
    if (h.solved == none)
        return;
    span.output.disturbed = true;
    BodyState& s = span.state_of(h.solved);
    const StateConstants& c = span.constants_of(h.solved);
    const Vec2 impulse = static_cast<float>(h.start - time) * (h.force * h.normal + h.friction * perp(h.normal));
    if (Flier* other = span.flier_at(h.solved))
    { // the other body has taken off since
        other->vx += other->inverse_mass_x * static_cast<double>(impulse.x);
        other->vy += other->inverse_mass_y * static_cast<double>(impulse.y);
        s.velocity += {c.inverse_mass.x * impulse.x, c.inverse_mass.y * impulse.y};
        return;
    }
    const Vec2 arm = h.point - to_vec2(span.sim_of(span.state.shapes[h.other].body).center + s.delta_position);
    correct_state(span, h.solved, span.h - 0.5 * (h.start + time), static_cast<double>(c.inverse_mass.x * impulse.x),
                  static_cast<double>(c.inverse_mass.y * impulse.y),
                  static_cast<double>(c.inverse_inertia * cross(arm, impulse)));
}

} // namespace

void release_resting_contacts(const FlightSpan& span, Flier& f, double time)
{
    for (const RestingContact& h : span.resting_contacts_of(f))
        push_back(span, h, time);
    fall_freely(span, f);
}

} // namespace carom::internal
