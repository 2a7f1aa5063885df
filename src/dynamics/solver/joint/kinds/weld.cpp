// Weld: the anchors coincide and the angle is held, C = (gap, angle): three rows, solved as one block.

#include "dynamics/solver/joint/kinds/joint_kinds.h"

namespace carom::internal {

void weld_rows(const JointPose& pose, JointRows& out)
{
    out.hold(x_row(pose, pose.gap.x));
    out.hold(y_row(pose, pose.gap.y));
    out.hold(angle_row(pose.angle));
}

} // namespace carom::internal
