#include "dynamics/solver/bounce/strikes.h"

#include "core/index.h"
#include "dynamics/solver/bounce/bounce_limit.h"

#include <utility>

namespace carom::internal {

namespace {

constexpr float least_approach = 0.5f; // of the rest speed: what gravity gives in a sub-step

BodySpeeds between(const BodySpeeds& from, const BodyState& to, float share)
{
    return {from.velocity + share * (to.velocity - from.velocity),
            from.angular_velocity + share * (to.angular_velocity - from.angular_velocity)};
}

void set_speeds_of(BodyState& s, const BodySpeeds& speeds)
{
    s.velocity = speeds.velocity;
    s.angular_velocity = speeds.angular_velocity;
}

} // namespace

template <class Visit>
void Strikes::for_each_point(const Visit& visit) const
{
    m_work.for_each_constraint(
        [&](ContactConstraint& constraint)
        {
            for (ConstraintPoint& p : std::span(constraint.points).first(as_index(constraint.count)))
                visit(constraint, p);
        });
}

template <class Visit>
void Strikes::for_each_body(const Visit& visit)
{
    const int first = m_work.island.first_state;
    for (int i = first + 1; i <= first + m_work.island.dynamic_count; ++i)
    {
        if ((m_work.view.states[i].flags & body_flag::flier) == 0)
            visit(i, m_work.output.noted_speeds[as_index(i - first)]);
    }
}

void Strikes::expect()
{
    m_are_expected = m_are_met = false;
    for_each_point(
        [&](const ContactConstraint& constraint, ConstraintPoint& p)
        {
            p.waits = p.normal_impulse == 0 && is_met(constraint, p) &&
                      -constraint_speed(m_work.view, constraint, p) > least_approach * m_work.ctx.rest_speed;
            m_are_expected |= p.waits;
        });
}

bool Strikes::is_met(const ContactConstraint& constraint, const ConstraintPoint& p) const
{
    const float separation = constraint_separation(m_work.view, constraint, p);
    return separation > 0 && separation < -m_work.view.h * constraint_speed(m_work.view, constraint, p);
}

void Strikes::meet()
{
    float fastest = 0;
    for_each_point(
        [&](const ContactConstraint& constraint, const ConstraintPoint& p)
        {
            const float approach = -constraint_speed(m_work.view, constraint, p);
            if (!p.waits || approach <= fastest || !is_met(constraint, p))
                return;
            m_are_met = true;
            m_time = constraint_separation(m_work.view, constraint, p) / (m_work.view.h * approach);
            fastest = approach;
        });
    if (m_are_met)
    {
        take_speeds(m_work.view, m_work.island, m_work.output.noted_speeds);
        note_impulses();
        note_arms();
    }
    end_waiting();
}

void Strikes::go_back()
{
    for_each_body(
        [&](int i, const BodySpeeds& momentum)
        {
            BodyState& s = m_work.view.states[i];
            set_speeds_of(s, momentum);
            set_speeds_of(s, between(m_work.scratch.solver.speeds[as_index(i)], s, m_time + 0.5f));
        });
    auto noted = m_work.output.noted_impulses.begin();
    m_work.for_each_constraint([&](ContactConstraint& constraint) { set_impulses(constraint, *noted++); });
}

void Strikes::begin_impacts()
{
    lay_impulses_aside();
    for_each_point([this](const ContactConstraint&, ConstraintPoint& p) { take_arms_of_meeting(p); });
}

// Bodies that a strike parts at an end pose that they would have reached apart keep their angular momentum only by the arms of the time when they met.
void Strikes::take_arms_of_meeting(ConstraintPoint& p) const
{
    const Vec2 ra = std::exchange(p.ra_other, p.ra);
    const Vec2 rb = std::exchange(p.rb_other, p.rb);
    if (ra == Vec2{} && rb == Vec2{})
        return; // a new point
    p.ra = ra + m_time * (p.ra - ra);
    p.rb = rb + m_time * (p.rb - rb);
}

void Strikes::begin_next()
{
    lay_impulses_aside();
    for_each_point(
        [](const ContactConstraint&, ConstraintPoint& p)
        {
            p.ra = std::exchange(p.ra_other, {});
            p.rb = std::exchange(p.rb_other, {});
        });
    take_speeds(m_work.view, m_work.island, m_work.output.noted_speeds);
    for_each_body(
        [&](int i, const BodySpeeds&)
        {
            m_work.view.states[i].velocity += m_work.view.h * m_work.view.constants[i].acceleration;
            m_work.view.states[i].angular_velocity += m_work.view.h * m_work.view.constants[i].angular_acceleration;
        });
}

void Strikes::finish()
{
    for_each_body([&](int i, const BodySpeeds& after)
                  { set_speeds_of(m_work.view.states[i], between(after, m_work.view.states[i], 0.5f - m_time)); });
    m_work.for_each_constraint([](ContactConstraint& constraint)
                               { add_to_sums(constraint, -1); }); // they are of the next sub-step
    m_are_met = false;
}

void Strikes::end_waiting()
{
    for_each_point([](const ContactConstraint&, ConstraintPoint& p) { p.waits = false; });
    m_are_expected = false;
}

void Strikes::note_arms()
{
    for_each_point(
        [](const ContactConstraint&, ConstraintPoint& p)
        {
            p.ra_other = p.ra;
            p.rb_other = p.rb;
        });
}

void Strikes::note_impulses()
{
    m_work.output.noted_impulses.clear();
    m_work.for_each_constraint(
        [&](const ContactConstraint& constraint)
        {
            ConstraintImpulses& noted =
                m_work.output.noted_impulses.emplace_back(ConstraintImpulses{{}, {}, constraint.rolling_impulse});
            for (int i = 0; i < constraint.count; ++i)
            {
                noted.normal[i] = constraint.points[i].normal_impulse;
                noted.tangent[i] = constraint.points[i].tangent_impulse;
            }
        });
}

void Strikes::lay_impulses_aside()
{
    m_work.for_each_constraint(
        [](ContactConstraint& constraint)
        {
            add_to_sums(constraint, 1);
            set_impulses(constraint, {});
        });
}

void Strikes::set_impulses(ContactConstraint& constraint, const ConstraintImpulses& impulses)
{
    constraint.rolling_impulse = impulses.rolling;
    for (int i = 0; i < constraint.count; ++i)
    {
        constraint.points[i].normal_impulse = impulses.normal[i];
        constraint.points[i].tangent_impulse = impulses.tangent[i];
    }
}

void Strikes::add_to_sums(ContactConstraint& constraint, float sign)
{
    for (int i = 0; i < constraint.count; ++i)
    {
        constraint.points[i].total_impulse += sign * constraint.points[i].normal_impulse;
        constraint.points[i].total_tangent += sign * constraint.points[i].tangent_impulse;
    }
}

} // namespace carom::internal
