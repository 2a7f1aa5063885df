#pragma once

// A contact as the solver sees it, prepared anew in each step. Symbols: a, b the bodies; n the normal from
// a to b, t = perp(n); r the lever arm; m the effective mass along a direction, 1 / (J M^-1 J^T).

#include "dynamics/solver/softness.h"
#include "dynamics/state/scene_state.h"

#include <cstdint>

namespace carom::internal {

struct ConstraintPoint
{
    Vec2 ra{}; ///< lever arms of the Jacobian
    Vec2 rb{};
    Vec2 ra0{}; ///< the same anchors in the orientation from which rotations count
    Vec2 rb0{};
    float base = 0; ///< separation = base + n · (relative displacement of the anchors)
    /// Error of the straight-line prediction of the separation over the next sub-step (round contacts).
    float predicted_curvature = 0;
    float normal_impulse = 0;
    float tangent_impulse = 0;
    float normal_mass = 0;
    float tangent_mass = 0;
    float separation_before = 0; ///< at the start of the sub-step, in islands whose energy is watched
    float approach = 0;          ///< speed at the start of the sub-step, of constraints that bear no load yet
    float last_impulse = 0;      ///< along the normal in the sub-step before
    float older_impulse = 0;     ///< and in the one before that
    float standing_load =
        0; ///< that it has borne of late, N s: the median of three sub-steps, so that neither a blow nor a pause in one of them counts
    float missing_load = 0;  ///< of that, what it did not bear in the sub-step before
    float total_impulse = 0; ///< over the step
    float total_tangent = 0;
};

struct ContactConstraint
{
    std::int32_t a = 0; ///< indices of states
    std::int32_t b = 0;
    std::int32_t contact = none;
    std::int32_t count = 0;
    Vec2 n{};
    float friction = 0;
    float surface_speed = 0;
    float coupling = 0; ///< J1 M^-1 J2^T of the two normals; 0 where the points are too near each other to be distinct
    float rolling = 0;  ///< torque limit over normal impulse, m
    float rolling_impulse = 0;
    float rolling_mass = 0;
    float core = 0;    ///< depth that it may reach, see core_depth(); 0 without an immovable body
    Rotation turn_a{}; ///< rotations of the bodies within the step when the manifold was last computed
    Rotation turn_b{};
    std::uint8_t refreshed = 0; ///< recomputed in every sub-step
    std::uint8_t followed = 0;  ///< recomputed when a body has turned
    std::uint8_t hit = 0;       ///< its impact was reported
    std::uint8_t halfway = 0;   ///< points, as bits, that have been stopped in part: the blow goes on
    std::uint8_t pressed = 0;   ///< bore a load in this sub-step before it was relaxed
    Softness softness{};
    ConstraintPoint points[2];
};

/// It has parted.
inline void forget_loads(ConstraintPoint& p) { p.last_impulse = p.older_impulse = p.standing_load = p.missing_load = 0; }

/// The sum of its normal impulses, which limits rolling.
[[nodiscard]] inline float load_of(const ContactConstraint& constraint)
{
    float load = 0;
    for (int i = 0; i < constraint.count; ++i)
        load += constraint.points[i].normal_impulse;
    return load;
}

/// Adds the constraint's impulses to its sums over the step; with a sign of -1, takes them out.
inline void add_to_sums(ContactConstraint& constraint, float sign)
{
    for (int i = 0; i < constraint.count; ++i)
    {
        constraint.points[i].total_impulse += sign * constraint.points[i].normal_impulse;
        constraint.points[i].total_tangent += sign * constraint.points[i].tangent_impulse;
    }
}

[[nodiscard]] inline bool bears_load(const ContactConstraint& constraint)
{
    return (constraint.count > 0 && constraint.points[0].normal_impulse > 0) ||
           (constraint.count == 2 && constraint.points[1].normal_impulse > 0);
}

/// For a body that has taken off. A constraint that only lacks points may still get some.
inline void drop(ContactConstraint& constraint) { constraint.count = constraint.refreshed = constraint.followed = 0; }
[[nodiscard]] inline bool is_dropped(const ContactConstraint& constraint)
{
    return constraint.count == 0 && constraint.refreshed == 0 && constraint.followed == 0;
}

} // namespace carom::internal
