#pragma once

// Spring: nothing is held; along the line between the anchors acts a spring with the stretch |gap| - length.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

template <class Equations>
void spring(const JointRecord& joint, const JointPose& pose, Equations& out)
{
    if (!joint.has_row)
        return;
    const float l = length(pose.gap);
    AxisActs acts;
    acts.has_spring = true;
    acts.stretch = l - joint.upper;
    out.free_line(0, acts, l > 0 ? (1 / l) * pose.gap : Vec2{1, 0}, l);
}

} // namespace carom::internal
