#pragma once

// Contacts of large islands, eight side by side: no two of a group share a moving body. They are solved in the contact's own frame. With
// n the normal, t = perp(n), and r the lever arm of a point, r × t = r · n, so that two scalars per body and point say everything:
//   across = r × n    the arm of the normal, and how the separation changes as the body turns
//   along  = r · n    the arm of the tangent, and how the separation curves
// Points and normals are those of the start of the step; what turns with them is the separation.

#include "core/lane_storage.h"
#include "dynamics/solver/contact/contact_constraint.h"

#include <cstdint>

namespace carom::internal {

struct WidePoint
{
    LaneFloats across_a;
    LaneFloats along_a;
    LaneFloats across_b;
    LaneFloats along_b;
    LaneFloats normal_impulse;
    LaneFloats tangent_impulse;
    LaneFloats tangent_mass;
    LaneFloats separation;    ///< at the poses that bodies have, as relaxing found it
    LaneFloats base;          ///< separation at the start of the step; later n · (relative displacement of the anchors) more
    LaneFloats total_impulse; ///< over the step
    LaneFloats total_tangent;
};

/// What solving reads and writes, and nothing else: constraints of a large island come from memory in every sub-step. What follows from the masses with little
/// arithmetic does not stand here.
struct alignas(64) WideContact
{
    LaneInts a; ///< states
    LaneInts b;
    LaneFloats nx;
    LaneFloats ny;
    LaneFloats inverse_mass_a; ///< 0 as the inertia: does not give way; read by all threads, written by none
    LaneFloats inverse_mass_b;
    LaneFloats inverse_inertia_a;
    LaneFloats inverse_inertia_b;
    LaneFloats friction;
    LaneFloats coupling; ///< of two normals, J1 M^-1 J2^T
    WidePoint points[2];
};
static_assert(sizeof(WideContact) == 1024);

/// Who stands in the lanes of a constraint, and what is known of their contacts; masks are of lanes.
struct alignas(64) WideContactNotes
{
    LaneInts contact; ///< none: the lane is empty
    LaneInts body_a;
    LaneInts body_b;
    LaneFloats approach[2];  ///< speed of the points at the start of the sub-step, of groups in which a lane may have been struck
    std::int32_t count;      ///< points, the same in all lanes
    std::uint32_t may_hit;   ///< bore nothing when the step began and have not been struck
    std::uint32_t loaded;    ///< the contact has contact_flag::loaded
    std::uint32_t untold;    ///< did not touch when the step began, and the touch is not told
    std::uint32_t edge_of_b; ///< the normal is that of an edge of b
    std::uint32_t nearest;   ///< the normal leads from corner to corner
    std::uint32_t kept;      ///< the manifold is kept
    std::uint32_t followed;  ///< the contact has contact_flag::followed
};

/// More constraints than this come from memory, for the third cache does not hold them: 8 MB.
inline constexpr std::int32_t most_near_constraints = 8'192;

/// Groups that have as many points each, and no two share a body that gives way.
struct WideBucket
{
    WideContact* constraints;
    WideContactNotes* notes;
    std::int32_t count;
    bool are_far; ///< those of the next turns are asked for
};

struct WideSoftness
{
    float h;
    float inverse_h;
    float push_speed;
    Softness contact;
    Softness stiff;   ///< against what has infinite mass
    float rest_speed; ///< approach below it is no blow
    float share = 1;  ///< of the impulses, that relaxing adds to the sums
};

} // namespace carom::internal
