#pragma once

// A joint as the solver sees it: rows of a Jacobian with their error at the present poses of the bodies. The file of a kind of joint (kinds/) contains only
// what is specific to it. joint_solver.cpp iterates over the rows of all kinds alike, and the direct solve reads the same rows.

#include "dynamics/solver/joint/joint_axis.h"
#include "dynamics/solver/softness.h"
#include "dynamics/state/scene_state.h"

#include <array>
#include <span>

namespace carom::internal {

/// One scalar equation: dC = d · (vb - va) + arm_b wb - arm_a wa. It is held at C = 0, or C is the coordinate of a free axis.
struct JointRow
{
    Vec2 d{};
    float arm_a = 0;
    float arm_b = 0;
    float error = 0;       ///< C
    bool is_angle = false; ///< d is 0 and both arms are 1
};

/// A line or angle along which the bodies may move relative to each other, and on which a spring, a motor or limits act.
struct JointAxis
{
    JointRow row;
    AxisActs acts;
    int number = 0;         ///< its place among the axes of this kind of joint, whether something acts on them or not
    float inverse_mass = 0; ///< while the held rows keep their speeds
    float reaction[most_joint_rows] = {}; ///< impulses by which the held rows keep their speeds, per unit impulse along the axis
};

/// The equations of a joint: held rows, and the axes on which something acts. Two bodies move relative to each other in three ways, so that there are at
/// most three in total.
struct JointRows
{
    JointRow held[most_joint_rows];
    JointAxis axis[most_joint_axes];
    int held_count = 0;
    int axis_count = 0;

    [[nodiscard]] std::span<const JointRow> holds() const { return {held, static_cast<std::size_t>(held_count)}; }
    [[nodiscard]] std::span<const JointAxis> axes() const { return {axis, static_cast<std::size_t>(axis_count)}; }
    [[nodiscard]] std::span<JointAxis> axes() { return {axis, static_cast<std::size_t>(axis_count)}; }
    [[nodiscard]] int count() const { return held_count + axis_count; }
    /// Held rows first.
    [[nodiscard]] const JointRow& row(int i) const { return i < held_count ? held[i] : axis[i - held_count].row; }
};

/// Impulse over mass = stretch e + speed u + acceleration a, for a spring; see springs.cpp.
struct SpringKick
{
    float stretch = 0;
    float speed = 0;
    float acceleration = 0;
    float straight = 0; ///< additional coefficient of the acceleration of a body that does not drift along a parabola
};

/// The present pose of the joint's bodies, within the step.
struct JointPose
{
    Vec2 ra{}; ///< lever arms
    Vec2 rb{};
    Vec2 gap{};  ///< anchor b - anchor a
    Vec2 axis{}; ///< axis of a slider
    float angle = 0;
};

using JointErrors = std::array<float, joint_errors>;

/// State of a free axis that outlives its rows, which are made anew at each pose.
struct AxisWork
{
    AxisSpring spring{}; ///< the joint's own, or that of its soft limits
    JointRow mean{};     ///< the line along which the spring's impulse acts over the sub-step
    bool has_mean = false;
    float approach[2] = {}; ///< speeds toward the lower and upper limit, before the forces of a sub-step
    float bounce[2] = {};   ///< speeds at which the joint is to leave its limits
};

/// A joint in the solver: its record and the states of its bodies.
struct JointWork
{
    std::int32_t joint = none;
    std::int32_t a = 0;
    std::int32_t b = 0;
    SpringKick before{};            ///< kick of a spring before the bodies move
    SpringKick after{};             ///< kick after they have moved
    AxisWork axes[most_joint_axes]; ///< by JointAxis::number
    Vec2 ra0{};                     ///< anchors from the centers of mass at the start of the step, world axes
    Vec2 rb0{};
    Vec2 axis0{};                ///< slider's axis at the start of the step
    Vec2 gap0{};                 ///< anchor b - anchor a at the start of the step
    float angle0 = 0;            ///< joint angle at the start of the step
    bool needs_angle = false;    ///< an angle is held or something acts on it
    bool wraps = false;          ///< its angle is held, and is that of the shortest rotation
    JointErrors errors_before{}; ///< errors at the start of the sub-step
    JointErrors moved{};         ///< parts of the errors that were made outside the solver and that it has not corrected yet
    bool yields = false;         ///< as in JointRecord
    Vec2 force_sum{};            ///< impulses over the step
    float torque_sum = 0;
    JointPose pose{}; ///< present pose, computed by place_joints
    JointRows rows{};

    /// The errors of the present rows.
    [[nodiscard]] JointErrors errors() const;

    /// Adds to the sums over the step, which are reported as acting on body b.
    void add(const JointRow& row, float impulse)
    {
        force_sum += impulse * row.d;
        if (row.is_angle)
            torque_sum += impulse * row.arm_b;
    }
};

/// All rows of a joint at a pose, with their errors and coordinates; a spring has none.
void place_rows(const JointRecord& joint, const JointPose& pose, JointRows& out);
[[nodiscard]] inline JointRows rows_at(const JointRecord& joint, const JointPose& pose)
{
    JointRows rows;
    place_rows(joint, pose, rows);
    return rows;
}

/// The errors and coordinates of these rows alone, for a pose at which the Jacobian does not matter.
using RowErrors = std::array<float, most_joint_rows>;
[[nodiscard]] RowErrors row_errors(const JointRecord& joint, const JointPose& pose);

/// Sets what follows from the definition of a joint, once that is written.
void derive_traits(JointRecord& joint);

/// Between two poses: the line along which a force between the anchors does the work F (l1 - l0) and keeps angular momentum, whatever the bodies do.
[[nodiscard]] JointRow mean_line(const JointPose& before, const JointPose& after);

/// A row along the world direction d through both anchors.
[[nodiscard]] inline JointRow line_row(Vec2 d, const JointPose& pose, float error)
{
    return {.d = d, .arm_a = cross(pose.ra, d), .arm_b = cross(pose.rb, d), .error = error};
}

/// The limits, motor and spring of a joint, on an axis that is at this coordinate.
[[nodiscard]] inline AxisActs acts_of(const JointRecord& joint, float coordinate)
{
    AxisActs acts;
    acts.has_spring = joint.hertz > 0;
    acts.stretch = coordinate - joint.spring_target;
    acts.motor_speed = joint.motor_speed;
    acts.most = joint.enable_motor ? joint.max_motor : 0;
    acts.has_lower = acts.has_upper = joint.enable_limit;
    acts.lower_error = coordinate - joint.lower;
    acts.upper_error = joint.upper - coordinate;
    return acts;
}

} // namespace carom::internal
