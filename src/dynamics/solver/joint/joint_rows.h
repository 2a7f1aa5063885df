#pragma once

// A joint as the solver sees it: rows of a Jacobian with their error at the present poses of the bodies. The file of a joint kind contains only what is
// specific to that kind. joint_solver.cpp iterates over the rows of all kinds alike, and the direct solve reads the same rows.

#include "dynamics/solver/joint/joint_axis.h"
#include "dynamics/solver/softness.h"
#include "dynamics/state/scene_state.h"

#include <array>
#include <span>

namespace carom::internal {

/// One scalar equation: dC = d · (vb - va) + arm_b wb - arm_a wa. It is held at C = 0, or it is the free axis along which spring, motor and limits act.
struct JointRow
{
    Vec2 d{};
    float arm_a = 0;
    float arm_b = 0;
    float error = 0; ///< C
    JointSlot slot = slot_x;
};

struct JointRows
{
    JointRow held[2];
    JointRow axis; ///< line or angle along which the bodies may move relative to each other, if anything acts along it
    AxisActs acts;
    int held_count = 0;
    float axis_inverse_mass = 0; ///< while the held rows keep their speeds
    float reaction[2] = {};      ///< impulses by which the held rows keep their speeds, per unit impulse along the axis

    void hold(const JointRow& row) { held[held_count++] = row; }
    void clear() { *this = {}; }
    [[nodiscard]] std::span<const JointRow> holds() const { return {held, static_cast<std::size_t>(held_count)}; }
    [[nodiscard]] bool has_axis() const { return acts.any(); }
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

/// A joint in the solver: its record and the states of its bodies.
struct JointWork
{
    std::int32_t joint = none;
    std::int32_t a = 0;
    std::int32_t b = 0;
    SpringKick before{}; ///< kick of a spring before the bodies move
    SpringKick after{};  ///< kick after they have moved
    AxisSpring spring{}; ///< spring along the free axis: the joint's own, or that of its soft limits
    Vec2 ra0{};          ///< anchors from the centers of mass at the start of the step, world axes
    Vec2 rb0{};
    Vec2 axis0{};                ///< slider's axis at the start of the step
    Vec2 gap0{};                 ///< anchor b - anchor a at the start of the step
    float angle0 = 0;            ///< joint angle at the start of the step
    bool wraps = false;          ///< its angle is that of the shortest rotation
    float approach[2] = {};      ///< speeds toward the lower and upper limit, before the forces of a sub-step
    float bounce[2] = {};        ///< speeds at which the joint is to leave its limits
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
        if (row.d == Vec2{})
            torque_sum += impulse * row.arm_b;
    }
};

/// C of the held rows; if there is only one, the second value is 0.
[[nodiscard]] inline Vec2 distance_error(const JointRecord& joint, const JointPose& pose)
{
    return {length(pose.gap) - joint.lower, 0};
}
[[nodiscard]] inline Vec2 revolute_error(const JointPose& pose) { return pose.gap; }
[[nodiscard]] inline Vec2 prismatic_error(const JointPose& pose) { return {dot(perp(pose.axis), pose.gap), pose.angle}; }

void distance_rows(const JointRecord& joint, const JointPose& pose, JointRows& out);
void revolute_holds(const JointPose& pose, JointRows& out); ///< the held rows only
void prismatic_holds(const JointPose& pose, JointRows& out);
void revolute_rows(const JointRecord& joint, const JointPose& pose, float h, JointRows& out);
void prismatic_rows(const JointRecord& joint, const JointPose& pose, float h, JointRows& out);

/// A row along the world direction d through both anchors.
[[nodiscard]] inline JointRow line_row(Vec2 d, const JointPose& pose, float error, JointSlot slot)
{
    return {.d = d, .arm_a = cross(pose.ra, d), .arm_b = cross(pose.rb, d), .error = error, .slot = slot};
}

/// A row of the relative angle.
[[nodiscard]] inline JointRow angle_row(float error, JointSlot slot)
{
    return {.arm_a = 1, .arm_b = 1, .error = error, .slot = slot};
}

/// Limits, motor and spring along a free coordinate, common to hinges and sliders.
void act_along_axis(const JointRecord& joint, float coordinate, float h, AxisActs& out);

/// The coordinate along the free axis: a length, an angle, or a translation.
[[nodiscard]] float axis_coordinate(const JointRecord& joint, const JointPose& pose);

} // namespace carom::internal
