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
        place_rows(state.joints[work.joint], work.pose, work.rows);
        weigh_rows(JointBodies(view, work), work.rows);
    }
}

void weigh_rows(const JointBodies& bodies, JointRows& rows)
{
    if (rows.axis_count == 0)
        return;
    const std::span<const JointRow> held = rows.holds();
    const HeldBlock block = bodies.block(held);
    for (JointAxis& axis : rows.axes())
    { // the Schur complement k - c^T K^-1 c, with K of the held rows and c their coupling with the axis
        float coupling[most_joint_rows];
        for (std::size_t i = 0; i < held.size(); ++i)
            axis.reaction[i] = coupling[i] = -bodies.couple(held[i], axis.row);
        block.solve(axis.reaction);
        axis.inverse_mass = bodies.couple(axis.row, axis.row);
        for (std::size_t i = 0; i < held.size(); ++i)
            axis.inverse_mass -= axis.reaction[i] * coupling[i];
        axis.inverse_mass = std::max(axis.inverse_mass, 0.0f);
    }
}

} // namespace carom::internal
