#pragma once

// Keeps bodies from being pulled or pressed through walls.

#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/solver/contact/wide_contacts.h"

#include <span>

namespace carom::internal {

/// The contacts of an island with immovable bodies: no body may pass through these, whatever pulls it.
class Walls
{
public:
    struct Constraints
    {
        std::span<const ContactConstraint> constraints;
        std::span<const ContactConstraint> late_constraints;
        std::span<const ContactConstraint> pulled; ///< contacts of jointed bodies that lie in lanes
        std::span<const WideContact> wide;
        std::span<const WideCore> cores;
    };

    Walls(const SolverView& view, const Constraints& constraints) : m_view(view), m_constraints(constraints) {}

    /// How much deeper the present speeds lead jointed bodies into walls within the sub-step, summed over their contacts.
    [[nodiscard]] float entry() const;

    /// The last line of defense against a far heavier body that presses another into a wall: moves a body back that is deeper than half of its inner radius.
    void guard_cores() const;
    /// The same, only for the lanes of blocks first to last.
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
