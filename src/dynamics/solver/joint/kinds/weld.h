#pragma once

// Weld: the anchors coincide and the angle is held, C = (gap, angle): three rows, solved as one block.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

template <class Equations>
void weld(const JointPose& pose, Equations& out)
{
    out.hold_x(pose.gap.x);
    out.hold_y(pose.gap.y);
    out.hold_angle(pose.angle);
}

} // namespace carom::internal
