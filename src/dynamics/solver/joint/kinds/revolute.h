#pragma once

// Revolute: the anchors coincide, C = gap (two rows, solved as one block). The angle may be limited, driven or sprung.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

template <class Equations>
void revolute(const JointRecord& joint, const JointPose& pose, Equations& out)
{
    out.hold_x(pose.gap.x);
    out.hold_y(pose.gap.y);
    out.free_angle(0, acts_of(joint, pose.angle), pose.angle);
}

} // namespace carom::internal
