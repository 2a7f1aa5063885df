#pragma once

// Prismatic: with u the axis (turning with body a) and n = perp(u), C1 = n · gap and C2 = the relative angle are held; the translation u · gap is free.
// Because u turns with a, the lever arm of a reaches to anchor b: dC1 = n · (vb - va) + (rb x n) wb - ((ra + gap) x n) wa.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

template <class Equations>
void prismatic(const JointRecord& joint, const JointPose& pose, Equations& out)
{
    const Vec2 n = perp(pose.axis);
    const float translation = dot(pose.axis, pose.gap);
    out.hold_carried(n, dot(n, pose.gap));
    out.hold_angle(pose.angle);
    out.free_carried(0, acts_of(joint, translation), pose.axis, translation);
}

} // namespace carom::internal
