#pragma once

// Contacts that are recomputed within the step: in islands of so few bodies that one contact decides where a body goes.

#include "dynamics/solver/solved_island.h"

namespace carom::internal {

class RecomputedContacts
{
public:
    explicit RecomputedContacts(SolvedIsland& work) : m_work(work) {}

    /// Adds constraints without points for pieces of chains and arcs that a body may come to face within the step.
    void add_constraints_beyond_seams();
    /// Finds the true separation at the pose that the present velocities lead to, less its straight-line prediction.
    void predict_curvatures();
    /// Recomputes contacts at the poses that have been reached.
    void recompute();

private:
    struct Facing
    {
        int contact;
        Manifold manifold;
    };

    void add_constraint_beyond_seam(int index, int body, std::int32_t own);
    void predict_curvature(ContactConstraint& constraint) const;
    [[nodiscard]] bool is_carried(const ContactConstraint& constraint) const;
    void predict_turn(ContactConstraint& constraint) const;
    void follow(ContactConstraint& constraint);
    [[nodiscard]] static bool has_turned(Rotation from, Rotation to, float least);
    void refresh_constraint(ContactConstraint& constraint);
    void roll_back(ContactConstraint& constraint);
    [[nodiscard]] bool has_constraint(int contact);
    [[nodiscard]] Manifold manifold_of(int index, const ContactConstraint& constraint, float ahead) const;
    [[nodiscard]] Facing facing(const ContactConstraint& constraint, float ahead) const;

    SolvedIsland& m_work;
};

} // namespace carom::internal
