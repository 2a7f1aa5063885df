// The poses, rows and errors of joints at given poses of their bodies.

#include "dynamics/solver/joint/joint_bodies.h"

#include "core/trigonometry.h"
#include "dynamics/solver/joint/direct/joint_matrix.h"
#include "dynamics/state/turns.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

// Bodies turn little within a step. There, the series of the arc sine is exact to the rounding of a float.
float angle_of(Rotation turn)
{
    const float s = turn.s;
    if (turn.c > 0 && std::fabs(s) < 0.15f)
    {
        const float z = s * s;
        return s * (1 + z * (1.0f / 6 + z * (3.0f / 40 + z * (15.0f / 336))));
    }
    return static_cast<float>(arc_tangent(turn.s, turn.c));
}

// The pose of a joint without its angle.
JointPose place_anchors(const JointWork& work, const Placement& a, const Placement& b)
{
    JointPose pose;
    pose.ra = rotate(a.turn, work.ra0);
    pose.rb = rotate(b.turn, work.rb0);
    pose.axis = rotate(a.turn, work.axis0);
    pose.gap = work.gap0 + (b.shift - a.shift) + (pose.rb - work.rb0) - (pose.ra - work.ra0);
    return pose;
}

float angle_between(const JointWork& work, const Placement& a, const Placement& b)
{
    if (work.wraps)
        return work.angle0 + angle_of(b.turn * inverse(a.turn));
    return work.angle0 + (angle_of(b.turn) - angle_of(a.turn)) + 2 * pi * static_cast<float>(b.turns - a.turns);
}

Placement placement(const BodyState& s) { return {s.delta_position, s.delta_rotation, s.turns}; }

} // namespace

JointPose joint_pose(const JointWork& work, const Placement& a, const Placement& b)
{
    JointPose pose = place_anchors(work, a, b);
    pose.angle = angle_between(work, a, b);
    return pose;
}

Vec2 held_error(const JointRecord& joint, const JointWork& work, const Placement& a, const Placement& b)
{
    JointPose pose = place_anchors(work, a, b);
    switch (joint.kind)
    {
    case JointType::Spring: break;
    case JointType::Distance: return distance_error(joint, pose);
    case JointType::Revolute: return revolute_error(pose);
    case JointType::Prismatic: pose.angle = angle_between(work, a, b); return prismatic_error(pose);
    }
    return {};
}

Placement placed_ahead(const SolverView& view, std::int32_t state)
{
    BodyState s = view.states[state];
    s.delta_position += drift(view, state);
    if (s.angular_velocity != 0)
        turn_by(s, view.h * s.angular_velocity);
    return placement(s);
}

JointPose present_pose(const SolverView& view, const JointWork& work)
{
    return joint_pose(work, placement(view.states[work.a]), placement(view.states[work.b]));
}

void place_joints(const SolverView& view, const SceneState& state, std::span<JointWork> joints)
{
    for (JointWork& work : joints)
    {
        const JointRecord& joint = state.joints[work.joint];
        const Placement a = placement(view.states[work.a]);
        const Placement b = placement(view.states[work.b]);
        work.pose = has_angle(joint) ? joint_pose(work, a, b) : place_anchors(work, a, b);
        work.rows.clear();
        place_rows(joint, work.pose, view.h, work.rows);
        if (work.rows.has_axis())
            weigh_axis(JointBodies(view, work), work.rows);
    }
}

// The Schur complement k - c^T K^-1 c, with K of the held rows and c their coupling with the axis.
void weigh_axis(const JointBodies& bodies, JointRows& rows)
{
    rows.axis_inverse_mass = bodies.couple(rows.axis, rows.axis);
    if (rows.held_count == 0)
        return;
    const JointRow& x = rows.held[0];
    const JointRow& y = rows.held[1];
    const float cx = bodies.couple(x, rows.axis);
    const float k11 = bodies.couple(x, x);
    if (rows.held_count == 1)
    {
        rows.reaction[0] = k11 > 0 ? -cx / k11 : 0;
    }
    else
    {
        const float cy = bodies.couple(y, rows.axis);
        const float k12 = bodies.couple(x, y);
        const float k22 = bodies.couple(y, y);
        const float det = k11 * k22 - k12 * k12;
        if (det > 1e-6f * k11 * k22)
        {
            rows.reaction[0] = (k12 * cy - k22 * cx) / det;
            rows.reaction[1] = (k12 * cx - k11 * cy) / det;
        }
        rows.axis_inverse_mass += rows.reaction[1] * cy;
    }
    rows.axis_inverse_mass = std::max(rows.axis_inverse_mass + rows.reaction[0] * cx, 0.0f);
}

JointErrors JointWork::errors() const
{
    JointErrors found{};
    for (int i = 0; i < rows.held_count; ++i)
        found[static_cast<std::size_t>(i)] = rows.held[i].error;
    if (rows.acts.has_lower)
        found[2] = std::min(rows.acts.lower_error, 0.0f);
    if (rows.acts.has_upper)
        found[3] = std::min(rows.acts.upper_error, 0.0f);
    return found;
}

void place_rows(const JointRecord& joint, const JointPose& pose, float h, JointRows& out)
{
    switch (joint.kind)
    {
    case JointType::Spring: break;
    case JointType::Distance: distance_rows(joint, pose, out); break;
    case JointType::Revolute: revolute_rows(joint, pose, h, out); break;
    case JointType::Prismatic: prismatic_rows(joint, pose, h, out); break;
    }
}

JointRows holding_rows(const JointRecord& joint, const JointPose& pose)
{
    JointRows rows;
    switch (joint.kind)
    {
    case JointType::Spring: break;
    case JointType::Distance: distance_rows(joint, pose, rows); break;
    case JointType::Revolute: revolute_holds(pose, rows); break;
    case JointType::Prismatic: prismatic_holds(pose, rows); break;
    }
    return rows;
}

bool only_holds(const JointRecord& joint)
{
    if (joint.kind == JointType::Distance)
        return joint.lower == joint.upper && joint.hertz == 0;
    return joint.kind != JointType::Spring && joint.hertz == 0 && !joint.enable_motor && !joint.enable_limit;
}

bool loses_energy(const JointRecord& joint)
{
    if (joint.kind != JointType::Revolute && joint.kind != JointType::Prismatic)
        return false;
    const bool brakes = joint.enable_motor && joint.motor_speed == 0 && joint.max_motor > 0;
    return brakes || (joint.hertz > 0 && joint.damping_ratio >= 0.1f);
}

int most_rows_of(const JointRecord& joint)
{
    if (joint.kind == JointType::Spring)
        return 0;
    return joint.kind == JointType::Distance ? 1 : only_holds(joint) ? 2 : most_joint_rows;
}

bool has_angle(const JointRecord& joint)
{
    return joint.kind == JointType::Prismatic || (joint.kind == JointType::Revolute && !only_holds(joint));
}

} // namespace carom::internal
