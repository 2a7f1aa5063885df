// What a hinge may do about its angle and a slider about its translation: limits, a motor, a spring.

#include "dynamics/joint_rows.h"

namespace carom::internal {

void add_free_axis(const JointRecord& joint, JointRow axis, float coordinate, float h, JointRows& out)
{
    if (joint.hertz > 0)
    {
        axis.kind = RowKind::Spring;
        axis.slot = slot_spring;
        axis.error = coordinate - joint.spring_target;
        axis.hertz = joint.hertz;
        axis.damping_ratio = joint.damping_ratio;
        out.add(axis);
        axis.hertz = 0;
    }
    if (joint.enable_motor)
    {
        axis.kind = RowKind::Motor;
        axis.slot = slot_motor;
        axis.target = joint.motor_speed;
        axis.max_impulse = h * joint.max_motor;
        out.add(axis);
    }
    if (joint.enable_limit)
    {
        axis.kind = RowKind::Limit;
        axis.slot = slot_lower;
        axis.error = coordinate - joint.lower;
        out.add(axis);
        out.add(opposite(axis, joint.upper - coordinate, slot_upper));
    }
}

} // namespace carom::internal
