#pragma once

// The kinds of joints. Each has one function, in a file of its own: the rows of the joint at a pose, with their errors and coordinates. The solvers know
// rows alone; place_rows in joint_rows.cpp selects the function.

#include "dynamics/solver/joint/joint_rows.h"

namespace carom::internal {

void distance_rows(const JointRecord& joint, const JointPose& pose, JointRows& out);
void revolute_rows(const JointRecord& joint, const JointPose& pose, JointRows& out);
void prismatic_rows(const JointRecord& joint, const JointPose& pose, JointRows& out);
void weld_rows(const JointPose& pose, JointRows& out);

} // namespace carom::internal
