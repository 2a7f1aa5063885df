// Revolute: the anchors coincide, C = gap (two rows, solved as one block). The angle may be limited, driven or sprung.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

void revolute_holds(const JointPose& pose, JointRows& out)
{
    const Vec2 error = revolute_error(pose);
    out.hold(line_row({1, 0}, pose, error.x, slot_x));
    out.hold(line_row({0, 1}, pose, error.y, slot_y));
}

void revolute_rows(const JointRecord& joint, const JointPose& pose, float h, JointRows& out)
{
    revolute_holds(pose, out);
    out.axis = angle_row(0, slot_motor);
    act_along_axis(joint, pose.angle, h, out.acts);
}

} // namespace carom::internal
