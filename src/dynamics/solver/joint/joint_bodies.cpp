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
    JointPose pose;
    pose.ra = rotate(a.turn, work.ra0);
    pose.rb = rotate(b.turn, work.rb0);
    pose.axis = rotate(a.turn, work.axis0);
    pose.gap = work.gap0 + (b.shift - a.shift) + (pose.rb - work.rb0) - (pose.ra - work.ra0);
    if (work.needs_angle)
        pose.angle = angle_between(work, a, b);
    return pose;
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
        work.pose = present_pose(view, work);
        work.rows = place_rows(state.joints[work.joint], work.pose);
        weigh_axes(JointBodies(view, work), work.rows);
    }
}

// The Schur complement k - c^T K^-1 c, with K of the held rows and c their coupling with the axis.
void weigh_axis(const JointBodies& bodies, std::span<const JointRow> held, JointAxis& axis)
{
    axis.inverse_mass = bodies.couple(axis.row, axis.row);
    if (held.empty())
        return;
    const JointRow& x = held[0];
    const float cx = bodies.couple(x, axis.row);
    const float k11 = bodies.couple(x, x);
    if (held.size() == 1)
    {
        axis.reaction[0] = k11 > 0 ? -cx / k11 : 0;
    }
    else
    {
        const JointRow& y = held[1];
        const float cy = bodies.couple(y, axis.row);
        const float k12 = bodies.couple(x, y);
        const float k22 = bodies.couple(y, y);
        const float det = k11 * k22 - k12 * k12;
        if (det > 1e-6f * k11 * k22)
        {
            axis.reaction[0] = (k12 * cy - k22 * cx) / det;
            axis.reaction[1] = (k12 * cx - k11 * cy) / det;
        }
        axis.inverse_mass += axis.reaction[1] * cy;
    }
    axis.inverse_mass = std::max(axis.inverse_mass + axis.reaction[0] * cx, 0.0f);
}

void weigh_axes(const JointBodies& bodies, JointRows& rows)
{
    for (JointAxis& axis : rows.axes())
        weigh_axis(bodies, rows.holds(), axis);
}

} // namespace carom::internal
