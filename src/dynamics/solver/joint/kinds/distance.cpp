// Distance joint: C = |gap| - length along the line between the anchors. Equal limits hold it, or spring it where it is soft; different limits bound it.

#include "dynamics/solver/joint/kinds/joint_kinds.h"

namespace carom::internal {

void distance_rows(const JointRecord& joint, const JointPose& pose, JointRows& out)
{
    const float l = length(pose.gap);
    const Vec2 d = l > 0 ? (1 / l) * pose.gap : Vec2{1, 0};
    const bool is_soft = joint.hertz > 0;
    const bool is_bounded = joint.lower != joint.upper;
    if (!is_bounded && !is_soft)
    {
        out.hold(line_row(d, pose, l - joint.lower));
        return;
    }
    AxisActs acts;
    acts.has_spring = !is_bounded;
    acts.soft_limits = is_bounded && is_soft;
    acts.has_lower = is_bounded && joint.lower > 0;
    acts.has_upper = is_bounded;
    acts.stretch = acts.lower_error = l - joint.lower;
    acts.upper_error = joint.upper - l;
    out.free(0, line_row(d, pose, l), acts);
}

} // namespace carom::internal
