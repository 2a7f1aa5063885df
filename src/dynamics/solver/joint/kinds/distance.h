#pragma once

// Distance joint: C = |gap| - length along the line between the anchors. Equal limits hold it, or spring it where it is soft; different limits bound it.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

template <class Equations>
void distance(const JointRecord& joint, const JointPose& pose, Equations& out)
{
    const float l = length(pose.gap);
    const Vec2 d = l > 0 ? (1 / l) * pose.gap : Vec2{1, 0};
    const bool is_soft = joint.hertz > 0;
    const bool is_bounded = joint.lower != joint.upper;
    if (!is_bounded && !is_soft)
    {
        out.hold_line(d, l - joint.lower);
        return;
    }
    AxisActs acts;
    acts.has_spring = !is_bounded;
    acts.soft_limits = is_bounded && is_soft;
    acts.has_lower = is_bounded && joint.lower > 0;
    acts.has_upper = is_bounded;
    acts.stretch = acts.lower_error = l - joint.lower;
    acts.upper_error = joint.upper - l;
    out.free_line(0, acts, d, l);
}

} // namespace carom::internal
