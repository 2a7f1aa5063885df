// Revolute: the anchors coincide, C = gap (two rows, solved as one block). The angle may be limited, driven or sprung.

#include "dynamics/solver/joint/kinds/joint_kinds.h"

namespace carom::internal {

void revolute_rows(const JointRecord& joint, const JointPose& pose, JointRows& out)
{
    out.hold(x_row(pose, pose.gap.x));
    out.hold(y_row(pose, pose.gap.y));
    out.free(0, angle_row(pose.angle), acts_of(joint, pose.angle));
}

} // namespace carom::internal
