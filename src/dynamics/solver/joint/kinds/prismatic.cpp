// Prismatic: with u the axis (turning with body a) and n = perp(u), C1 = n · gap and C2 = the relative angle are held; the translation u · gap is free.
// Because u turns with a, the lever arm of a reaches to anchor b: dC1 = n · (vb - va) + (rb x n) wb - ((ra + gap) x n) wa.

#include "dynamics/solver/joint/kinds/joint_kinds.h"

namespace carom::internal {

void prismatic_rows(const JointRecord& joint, const JointPose& pose, JointRows& out)
{
    const Vec2 n = perp(pose.axis);
    const float translation = dot(pose.axis, pose.gap);
    out.hold(carried_row(n, pose, dot(n, pose.gap)));
    out.hold(angle_row(pose.angle));
    out.free(0, carried_row(pose.axis, pose, translation), acts_of(joint, translation));
}

} // namespace carom::internal
