// The free axis of a joint: limits, a motor and a spring act on the angle of a hinge or on the translation of a slider.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

void act_along_axis(const JointRecord& joint, float coordinate, float h, AxisActs& out)
{
    out.has_spring = joint.hertz > 0;
    out.stretch = coordinate - joint.spring_target;
    out.motor_speed = joint.motor_speed;
    out.most = joint.enable_motor ? h * joint.max_motor : 0;
    out.has_lower = out.has_upper = joint.enable_limit;
    out.lower_error = coordinate - joint.lower;
    out.upper_error = joint.upper - coordinate;
}

float axis_coordinate(const JointRecord& joint, const JointPose& pose)
{
    switch (joint.kind)
    {
    case JointType::Spring: break;
    case JointType::Distance: return length(pose.gap);
    case JointType::Revolute: return pose.angle;
    case JointType::Prismatic: return dot(pose.axis, pose.gap);
    }
    return 0;
}

} // namespace carom::internal
