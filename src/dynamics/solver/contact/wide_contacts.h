#pragma once

// Contacts of large islands, eight side by side: no two in a block share a body that has finite mass. They are solved in the contact's own
// frame. With n the normal, t = perp(n), and r the lever arm of a point, r × t = r · n, so that two scalars per body and point suffice:
//   across = r × n    the arm of the normal, and how the separation changes as the body turns
//   along  = r · n    the arm of the tangent, and the curvature of the separation
// Points and normals are those of the start of the step, but for the arms: those of the middle of the step are right in the mean. The separation follows
// the rotation. See begin_at_middle().

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
    LaneFloats separation;    ///< at the present poses, as relaxing found it
    LaneFloats base;          ///< separation without n · (displacement of the anchors since the pose from which states count)
    LaneFloats total_impulse; ///< over the step
    LaneFloats total_tangent;
};

/// Holds only what solving reads and writes: the constraints of a large island come from memory in
/// every sub-step. Values that follow from the masses with little arithmetic are not stored.
struct alignas(64) WideContact
{
    LaneInts a; ///< indices of states
    LaneInts b;
    LaneFloats nx;
    LaneFloats ny;
    LaneFloats inverse_mass_a; ///< 0 like the inertia for an immovable body, which all threads read and none writes
    LaneFloats inverse_mass_b;
    LaneFloats inverse_inertia_a;
    LaneFloats inverse_inertia_b;
    LaneFloats friction;
    LaneFloats coupling; ///< of the two normals, J1 M^-1 J2^T
    WidePoint points[2];
};
static_assert(sizeof(WideContact) == 1024);

/// Rolling resistance and conveyors, beside the constraints of the buckets that have them; other buckets neither read nor write theirs.
struct alignas(64) WideFeatures
{
    LaneFloats surface_speed;
    LaneFloats rolling; ///< torque limit over normal impulse, m
    LaneFloats rolling_impulse;
};

/// The contacts in the lanes of a constraint and what is known of them; masks have a bit for each lane, or for each point.
struct alignas(64) WideContactNotes
{
    LaneInts contact; ///< none: the lane is empty
    LaneInts body_a;
    LaneInts body_b;
    LaneFloats approach[2]; ///< of the points at the start of the sub-step, in blocks in which a lane may have been struck
    std::int8_t count;      ///< number of points, the same in all lanes
    std::int8_t featured;   ///< whether WideFeatures count; the same in a bucket
    std::uint16_t paused;   ///< points that bore nothing in a sub-step, but have hardly parted
    /// Points that bore no load when the step began and have not been struck, or are halfway, see may_hit_bit; points of empty lanes too. And see lost_bit.
    std::uint32_t may_hit;
    std::uint32_t loaded;     ///< the contact has contact_flag::loaded
    std::uint32_t unreported; ///< did not touch when the step began, and the touch is not reported yet
    std::uint32_t edge_of_b;  ///< the normal is that of an edge of b
    std::uint32_t nearest;    ///< the normal leads from corner to corner
    std::uint32_t cached;     ///< the manifold is cached
    std::uint16_t followed;   ///< the contact has contact_flag::followed
    std::uint16_t halfway;    ///< points that bear a load but still approach, see halfway_gap(): the blow goes on
};

/// Lanes of the second points come behind those of the first.
[[nodiscard]] constexpr std::uint32_t may_hit_bit(int lane, int point) { return 1u << (lane + point * lane_count); }
/// The point has lost its load in an earlier sub-step of the step.
[[nodiscard]] constexpr std::uint32_t lost_bit(int lane, int point) { return 1u << (lane + (2 + point) * lane_count); }

/// Lanes in a sub-step, as bits: a byte for each block.
struct BlowBits
{
    std::uint8_t* struck;   ///< bear a load and were struck, or touch for the first time
    std::uint8_t* relieved; ///< have a point that bears no load any more
};

/// Blocks with the same number of points, no two of which share a body that has finite mass.
struct WideBucket
{
    WideContact* constraints;
    WideContactNotes* notes;
    WideFeatures* features;
    std::int32_t count;
    bool are_far; ///< they come from memory: later ones are prefetched
};

struct WideSoftness
{
    float h;
    float inverse_h;
    float push_speed;
    Softness contact;
    Softness stiff;   ///< against bodies of infinite mass
    float least_blow; ///< see least_blow()
};

} // namespace carom::internal
