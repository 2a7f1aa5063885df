// Distance joint: C = |gap| - length along the line between the anchors. Equal limits hold it, or spring it where it is soft; different limits bound it.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

void distance_rows(const JointRecord& joint, const JointPose& pose, JointRows& out)
{
    const float l = length(pose.gap);
    const Vec2 d = l > 0 ? (1 / l) * pose.gap : Vec2{1, 0};
    const bool is_soft = joint.hertz > 0;
    if (joint.lower == joint.upper && !is_soft)
    {
        out.hold(line_row(d, pose, distance_error(joint, pose).x, slot_axis));
        return;
    }
    out.axis = line_row(d, pose, 0, slot_axis);
    if (joint.lower == joint.upper)
    {
        out.acts.has_spring = true;
        out.acts.stretch = l - joint.lower;
        return;
    }
    out.acts.soft_limits = is_soft;
    out.acts.has_lower = joint.lower > 0;
    out.acts.has_upper = true;
    out.acts.lower_error = l - joint.lower;
    out.acts.upper_error = joint.upper - l;
}

} // namespace carom::internal
