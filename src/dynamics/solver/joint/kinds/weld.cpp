// Weld: the anchors coincide and the angle is held, C = (gap, angle): three rows, solved as one block.

#include "dynamics/solver/joint/kinds/joint_kinds.h"

namespace carom::internal {

void weld_rows(const JointPose& pose, JointRows& out)
{
    out.hold(line_row({1, 0}, pose, pose.gap.x));
    out.hold(line_row({0, 1}, pose, pose.gap.y));
    out.hold(angle_row(pose.angle));
}

} // namespace carom::internal
