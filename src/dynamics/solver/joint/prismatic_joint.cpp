// Prismatic: with u the axis (turning with body a) and n = perp(u), C1 = n · gap and C2 = the relative angle are held; the translation u · gap is free.
// Because u turns with a, the lever arm of a reaches to anchor b: dC1 = n · (vb - va) + (rb x n) wb - ((ra + gap) x n) wa.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

namespace {

JointRow slider_row(Vec2 d, const JointPose& pose, float error, JointSlot slot)
{
    JointRow row = line_row(d, pose, error, slot);
    row.arm_a = cross(pose.ra + pose.gap, d);
    return row;
}

} // namespace

void prismatic_holds(const JointPose& pose, JointRows& out)
{
    const Vec2 n = perp(pose.axis);
    const Vec2 error = prismatic_error(pose);
    out.hold(slider_row(n, pose, error.x, slot_x));
    out.hold(angle_row(error.y, slot_lock));
}

void prismatic_rows(const JointRecord& joint, const JointPose& pose, float h, JointRows& out)
{
    prismatic_holds(pose, out);
    out.axis = slider_row(pose.axis, pose, 0, slot_motor);
    act_along_axis(joint, dot(pose.axis, pose.gap), h, out.acts);
}

} // namespace carom::internal
