#pragma once

// Hinges of large islands, eight side by side: no two of a group share a moving body. A hinge holds two anchors together; of some the angle is
// limited, driven or sprung as well.

#include "core/lane_storage.h"
#include "dynamics/solver/body_state.h"
#include "dynamics/solver/softness.h"

#include <cstdint>

namespace carom::internal {

/// What a hinge does about its angle; where it does nothing the numbers are such that no impulse comes of it.
struct WideAngle
{
    LaneFloats start; ///< the angle at the start of the step
    LaneFloats now;   ///< at the poses that bodies have, as relaxing found it
    LaneFloats target;
    LaneFloats spring_rate;        ///< at which the spring gives nothing, per stretch
    LaneFloats spring_conductance; ///< impulse per rate that it misses
    LaneFloats spring_impulse;
    LaneFloats motor_speed;
    LaneFloats motor_max; ///< impulse in a sub-step
    LaneFloats motor_impulse;
    LaneFloats lower;
    LaneFloats upper;
    LaneFloats lower_impulse;
    LaneFloats upper_impulse;
    LaneFloats torque_sum; ///< of impulses over the step
};

/// Where a hinge's anchors are, world axes.
struct WideArms
{
    LaneFloats ax; ///< anchors from the centers of mass
    LaneFloats ay;
    LaneFloats bx;
    LaneFloats by;
    LaneFloats gap_x; ///< anchor b - anchor a
    LaneFloats gap_y;
};

/// What the arms are turned from.
struct WideAnchors
{
    LaneInts body_a; ///< none: the world
    LaneInts body_b;
    LaneFloats ax; ///< anchors from the centers of mass, axes of the bodies
    LaneFloats ay;
    LaneFloats bx;
    LaneFloats by;
};

struct WideJoint
{
    LaneInts a; ///< states
    LaneInts b;
    LaneInts joint; ///< none: the lane is empty
    LaneFloats inverse_mass_a;
    LaneFloats inverse_mass_b;
    LaneFloats inverse_inertia_a;
    LaneFloats inverse_inertia_b;
    WideAnchors anchors;
    WideArms start; ///< of the step
    WideArms now;   ///< at the poses that bodies have, as relaxing found them
    LaneFloats impulse_x;
    LaneFloats impulse_y;
    LaneFloats sum_x; ///< over the step
    LaneFloats sum_y;
    WideAngle angle;
    std::int32_t turns;    ///< whether any lane does something about its angle
    std::uint32_t fixed_a; ///< lanes whose body a does not give way
    std::uint32_t fixed_b;
    std::int32_t padding[5];
};

struct JointSoftness
{
    float inverse_h;
    Softness soft;
    float share = 1; ///< of the impulses, that relaxing adds to the sums
};

} // namespace carom::internal
