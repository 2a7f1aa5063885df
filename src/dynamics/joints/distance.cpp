// Distance: C = |gap| - length along the line between the anchors; equal limits hold it, different ones bound it.

#include "dynamics/joint_rows.h"

namespace carom::internal {

void distance_rows(const JointRecord& joint, const JointPose& pose, JointRows& out)
{
    const float l = length(pose.gap);
    const Vec2 d = l > 0 ? (1 / l) * pose.gap : Vec2{1, 0};
    JointRow row = line_row(d, pose, distance_error(joint, pose).x, RowKind::Hold, slot_axis);
    row.hertz = joint.hertz;
    row.damping_ratio = joint.damping_ratio;
    if (joint.lower == joint.upper)
    {
        out.add(row);
        return;
    }
    row.kind = RowKind::Limit;
    row.slot = slot_lower;
    if (joint.lower > 0)
        out.add(row);
    out.add(opposite(row, joint.upper - l, slot_upper));
}

} // namespace carom::internal
