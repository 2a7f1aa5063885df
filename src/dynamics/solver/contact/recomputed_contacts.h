#pragma once

// Contacts that are found anew within the step: of bodies so few that a contact decides where one of them goes.

#include "dynamics/solver/solved_island.h"

namespace carom::internal {

class RecomputedContacts
{
public:
    explicit RecomputedContacts(SolvedIsland& work) : m_work(work) {}

    /// Constraints without points, for pieces of chains and arcs that a body may come to face within the step.
    void add_constraints_beyond_seams();
    /// The true separation at the pose that the present velocities lead to, less the straight-line prediction of it.
    void predict_curvatures();
    /// At the poses that have been reached.
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
