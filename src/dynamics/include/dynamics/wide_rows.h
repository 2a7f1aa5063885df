#pragma once

// Contacts of large units, eight side by side: no two of a group share a moving body. They are solved in the contact's own frame. With
// n the normal, t = perp(n), and r the lever arm of a point, r × t = r · n, so that two scalars per body and point say everything:
//   across = r × n    the arm of the normal, and how the separation changes as the body turns
//   along  = r · n    the arm of the tangent, and how the separation curves
// Points and normals are those of the start of the step; what turns with them is the separation.

#include "core/lanes.h"
#include "dynamics/rows.h"

#include <cstdint>

namespace carom::internal {

struct WidePoint
{
    LaneFloats across_a;
    LaneFloats along_a;
    LaneFloats across_b;
    LaneFloats along_b;
    LaneFloats base;       ///< separation at the start of the step; later n · (relative displacement of the anchors) more
    LaneFloats separation; ///< at the poses that bodies have, as relaxing found it
    LaneFloats k;          ///< J M^-1 J^T of the normal; 1 in empty lanes
    LaneFloats tangent_mass;
    LaneFloats normal_impulse;
    LaneFloats tangent_impulse;
    LaneFloats total_impulse; ///< over the step
    LaneFloats total_tangent;
    LaneFloats approach; ///< speed at the start of the sub-step, of groups in which a lane may have been struck
};

struct WideRow
{
    LaneInts a; ///< states
    LaneInts b;
    LaneInts contact; ///< none: the lane is empty
    LaneInts body_a;
    LaneInts body_b;
    LaneInts stiff; ///< -1: against what has infinite mass
    LaneFloats nx;
    LaneFloats ny;
    LaneFloats friction;
    LaneFloats inverse_mass_a;
    LaneFloats inverse_mass_b;
    LaneFloats inverse_inertia_a;
    LaneFloats inverse_inertia_b;
    LaneFloats coupling; ///< of two normals, J1 M^-1 J2^T
    WidePoint points[2];
    std::int32_t count;    ///< points, the same in all lanes
    std::uint32_t may_hit; ///< lanes that bore nothing when the step began and have not been struck
    std::uint32_t loaded;  ///< lanes whose contact has contact_flag::loaded
    std::uint32_t untold;  ///< lanes that did not touch when the step began and whose touch is not told
    std::uint32_t fixed_a; ///< lanes whose body a does not give way; what all threads read, none writes
    std::uint32_t fixed_b;
    std::uint32_t edge_of_b; ///< lanes whose normal is that of an edge of b
    std::uint32_t nearest;   ///< lanes whose normal leads from corner to corner
    std::uint32_t kept;      ///< lanes whose manifold is kept
    std::uint32_t followed;  ///< lanes whose contact has contact_flag::followed
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
