#pragma once

// Impulses beside those of the passes over contacts.

#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/solver/workspace.h"

#include <vector>

namespace carom::internal {

class Pushes
{
public:
    /// notes: the island warm starts by body, from the change of its speeds; impulses that no constraint applies again must not count in it.
    Pushes(const SolverView& view, std::vector<BodySpeeds>& unpushed, bool notes)
        : m_view(view), m_unpushed(unpushed), m_notes(notes)
    {}

    /// A body of infinite mass may be in all partitions: all threads read it, and none writes it.
    [[nodiscard]] bool has_finite_mass(std::int32_t state) const
    {
        const StateConstants& c = m_view.constants[state];
        return c.inverse_mass != Vec2{} || c.inverse_inertia != 0;
    }

    /// Pushes the bodies apart at their point. The constraint applies it again in the next sub-step.
    void apply(const ContactConstraint& constraint, const ConstraintPoint& p, Vec2 impulse) const
    {
        apply(constraint.a, p.ra, -impulse);
        apply(constraint.b, p.rb, impulse);
    }

    /// Notes an impulse that no constraint applies again.
    void note(const ContactConstraint& constraint, const ConstraintPoint& p, Vec2 impulse) const
    {
        if (!m_notes)
            return;
        note(constraint.a, p.ra, -impulse);
        note(constraint.b, p.rb, impulse);
    }

private:
    void apply(std::int32_t state, Vec2 arm, Vec2 impulse) const
    {
        if (has_finite_mass(state))
            apply_impulse(m_view.states[state], m_view.constants[state], arm, impulse);
    }

    void note(std::int32_t state, Vec2 arm, Vec2 impulse) const
    {
        if (!has_finite_mass(state))
            return;
        const StateConstants& c = m_view.constants[state];
        BodySpeeds& unpushed = m_unpushed[static_cast<std::size_t>(state)];
        unpushed.velocity.x += c.inverse_mass.x * impulse.x;
        unpushed.velocity.y += c.inverse_mass.y * impulse.y;
        unpushed.angular_velocity += c.inverse_inertia * cross(arm, impulse);
    }

    const SolverView& m_view;
    std::vector<BodySpeeds>& m_unpushed;
    bool m_notes;
};

} // namespace carom::internal
