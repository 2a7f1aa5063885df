// What a hinge may do about its angle and a slider about its translation: limits, a motor, a spring.

#include "dynamics/joint_rows.h"

namespace carom::internal {

void add_free_axis(const JointRecord& joint, float coordinate, float h, JointRows& out)
{
    if (joint.hertz > 0)
        out.act({.kind = FreeKind::Spring, .is_soft = true, .slot = slot_spring, .error = coordinate - joint.spring_target});
    if (joint.enable_motor)
        out.act({.kind = FreeKind::Motor, .slot = slot_motor, .target = joint.motor_speed, .max_impulse = h * joint.max_motor});
    if (joint.enable_limit)
    {
        out.act({.kind = FreeKind::Limit, .slot = slot_lower, .error = coordinate - joint.lower});
        out.act({.kind = FreeKind::Limit, .slot = slot_upper, .sign = -1, .error = joint.upper - coordinate});
    }
}

} // namespace carom::internal
