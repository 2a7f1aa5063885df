#pragma once

// Wide joints: the hinges of large islands in blocks of eight lanes. No two lanes of a block share a body with finite mass. A hinge holds two anchors
// together; its angle may be limited, driven or sprung as well.

#include "core/lane_storage.h"
#include "dynamics/solver/body_state.h"
#include "dynamics/solver/softness.h"

#include <cstdint>

namespace carom::internal {

/// Spring, motor and limits on the angle of a hinge. In a lane without them, the values are such that no impulse results.
struct WideAngle
{
    LaneFloats start; ///< the angle at the start of the step
    LaneFloats now;   ///< angle at the present poses, as computed by the relaxation
    LaneFloats target;
    LaneFloats spring_rate;        ///< rate at which the spring gives no impulse, per stretch
    LaneFloats spring_conductance; ///< impulse per deviation from that rate
    LaneFloats spring_impulse;
    LaneFloats motor_speed;
    LaneFloats motor_max; ///< greatest impulse in a sub-step
    LaneFloats motor_impulse;
    LaneFloats lower;
    LaneFloats upper;
    LaneFloats lower_impulse;
    LaneFloats upper_impulse;
    LaneFloats torque_sum; ///< sum of the impulses over the step
};

/// The anchors of a hinge, in world axes.
struct WideArms
{
    LaneFloats ax; ///< anchors from the centers of mass
    LaneFloats ay;
    LaneFloats bx;
    LaneFloats by;
    LaneFloats gap_x; ///< anchor b - anchor a
    LaneFloats gap_y;
};

/// The anchors in body axes, from which the arms are rotated.
struct WideAnchors
{
    LaneInts body_a; ///< none: the world
    LaneInts body_b;
    LaneFloats ax; ///< anchors from the centers of mass, in body axes
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
    WideArms start; ///< at the start of the step
    WideArms now;   ///< at the present poses, as computed by the relaxation
    LaneFloats impulse_x;
    LaneFloats impulse_y;
    LaneFloats sum_x; ///< sum of the impulses over the step
    LaneFloats sum_y;
    WideAngle angle;
    std::int32_t turns;    ///< whether the angle of any lane is limited, driven or sprung
    std::uint32_t fixed_a; ///< lanes whose body a has infinite mass
    std::uint32_t fixed_b;
    std::int32_t padding[5];
};

struct JointSoftness
{
    float inverse_h;
    Softness soft;
    float share = 1; ///< share of the impulses that the relaxation adds to the sums
};

} // namespace carom::internal
