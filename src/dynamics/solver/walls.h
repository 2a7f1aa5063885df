#pragma once

#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/solver/contact/wide_contacts.h"

#include <span>

namespace carom::internal {

/// The contacts of an island with bodies that do not give way: nothing goes through these, whatever pulls.
class Walls
{
public:
    struct Constraints
    {
        std::span<const ContactConstraint> constraints;
        std::span<const ContactConstraint> late_constraints;
        std::span<const ContactConstraint> pulled; ///< of bodies in joints, that stand in lanes
        std::span<const WideContact> wide;
        std::span<const WideCore> cores;
    };

    Walls(const SolverView& view, const Constraints& constraints) : m_view(view), m_constraints(constraints) {}

    /// How much deeper the present speeds lead bodies in joints into them within the sub-step, in all.
    [[nodiscard]] float entry() const;

    /// The last line of defence, for what something far heavier presses into a wall: moves it back where it is deeper than half of what is inside it.
    void guard_cores() const;
    /// The same for the lanes of groups first to last alone.
    void guard_wide_cores(int first, int last) const;

private:
    [[nodiscard]] bool is_jointed(const ContactConstraint& constraint) const;
    [[nodiscard]] float entry(const ContactConstraint& constraint) const;
    int guard_constraints(float part) const;
    bool guard_core(const ContactConstraint& constraint, float part) const;
    void guard_wide_core(const WideCore& core) const;
    void push_out(std::int32_t state, Vec2 displacement) const;

    const SolverView& m_view;
    Constraints m_constraints;
};

} // namespace carom::internal
