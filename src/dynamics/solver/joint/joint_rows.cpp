// The rows of joints of all kinds, and the properties that follow from them.

#include "dynamics/solver/joint/joint_rows.h"

#include "dynamics/solver/joint/joint_bodies.h"
#include "dynamics/solver/joint/kinds/joint_kinds.h"

#include <algorithm>

namespace carom::internal {

void place_rows(const JointRecord& joint, const JointPose& pose, JointRows& out)
{
    out.clear();
    switch (joint.kind)
    {
    case JointType::Spring: break;
    case JointType::Distance: distance_rows(joint, pose, out); break;
    case JointType::Revolute: revolute_rows(joint, pose, out); break;
    case JointType::Prismatic: prismatic_rows(joint, pose, out); break;
    case JointType::Weld: weld_rows(pose, out); break;
    }
}

JointErrors JointWork::errors() const
{
    JointErrors found{};
    for (std::size_t i = 0; i < rows.holds().size(); ++i)
        found[i] = rows.held[i].error;
    for (const JointAxis& axis : rows.axes())
    {
        if (axis.acts.has_lower)
            found[error_of_limit(axis.number, slot_lower)] = std::min(axis.acts.lower_error, 0.0f);
        if (axis.acts.has_upper)
            found[error_of_limit(axis.number, slot_upper)] = std::min(axis.acts.upper_error, 0.0f);
    }
    return found;
}

void derive_traits(JointRecord& joint)
{
    const JointRows rows = rows_at(joint, {});
    joint.only_holds = rows.held_count > 0 && rows.axis_count == 0;
    joint.loses_energy = std::ranges::any_of(rows.axes(),
                                             [&](const JointAxis& axis)
                                             {
                                                 const bool brakes = axis.acts.most > 0 && axis.acts.motor_speed == 0;
                                                 return brakes || (axis.acts.has_spring && joint.damping_ratio >= 0.1f);
                                             });
}

} // namespace carom::internal
