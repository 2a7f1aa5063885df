#pragma once

// A joint in the words of the solver: rows of a Jacobian with their error at the pose the bodies have now. A joint's file says only what is
// its own; joint_solver.cpp iterates over the rows of all kinds alike (and a direct solve over a tree of joints can read the same rows).

#include "dynamics/solver/joint/joint_axis.h"
#include "dynamics/solver/softness.h"
#include "dynamics/state/scene_state.h"

#include <array>
#include <span>

namespace carom::internal {

/// dC = d · (vb - va) + arm_b wb - arm_a wa. Held at C = 0, or one that others act along.
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
    JointRow axis; ///< the one line or angle along which the bodies may move against each other, where anything acts on that
    AxisActs acts;
    int held_count = 0;
    float axis_inverse_mass = 0; ///< while the held rows keep their speeds
    float reaction[2] = {};      ///< impulses of the held rows by which they do, for an impulse of 1 along the axis

    void hold(const JointRow& row) { held[held_count++] = row; }
    void clear() { *this = {}; }
    [[nodiscard]] std::span<const JointRow> holds() const { return {held, static_cast<std::size_t>(held_count)}; }
    [[nodiscard]] bool has_axis() const { return acts.any(); }
};

/// Impulse over mass = stretch e + speed u + acceleration a: of a spring, see springs.cpp.
struct SpringKick
{
    float stretch = 0;
    float speed = 0;
    float acceleration = 0;
    float straight = 0; ///< by the acceleration of a body that does not drift along a parabola, beside that
};

/// Where the joint's bodies are now, within the step.
struct JointPose
{
    Vec2 ra{}; ///< lever arms
    Vec2 rb{};
    Vec2 gap{};  ///< anchor b - anchor a
    Vec2 axis{}; ///< slider
    float angle = 0;
};

using JointErrors = std::array<float, joint_errors>;

/// A joint in the solver: its record and the states of its bodies.
struct JointWork
{
    std::int32_t joint = none;
    std::int32_t a = 0;
    std::int32_t b = 0;
    SpringKick before{}; ///< of a spring, before the bodies move
    SpringKick after{};  ///< and after
    AxisSpring spring{}; ///< along the free axis: of its own, or of its limits
    Vec2 ra0{};          ///< anchors from the centers of mass at the start of the step, world axes
    Vec2 rb0{};
    Vec2 axis0{};                ///< slider's axis at the start of the step
    Vec2 gap0{};                 ///< anchor b - anchor a at the start of the step
    float angle0 = 0;            ///< joint angle at the start of the step
    bool wraps = false;          ///< its angle is that of the shortest way
    float approach[2] = {};      ///< towards the lower and upper limit, before a sub-step's forces
    float bounce[2] = {};        ///< speeds at which it is to leave them
    JointErrors errors_before{}; ///< when the sub-step began
    JointErrors moved{};         ///< of these, what others than the solver have moved and it has not made good yet
    bool yields = false;         ///< as in JointRecord
    Vec2 force_sum{};            ///< impulses over the step
    float torque_sum = 0;
    JointPose pose{}; ///< as the bodies stand, since place_joints
    JointRows rows{};

    /// As the rows stand.
    [[nodiscard]] JointErrors errors() const;

    /// To the sums over the step, which are told as on body b.
    void add(const JointRow& row, float impulse)
    {
        force_sum += impulse * row.d;
        if (row.d == Vec2{})
            torque_sum += impulse * row.arm_b;
    }
};

/// C of the rows that are held: of one alone, the second is 0.
[[nodiscard]] inline Vec2 distance_error(const JointRecord& joint, const JointPose& pose)
{
    return {length(pose.gap) - joint.lower, 0};
}
[[nodiscard]] inline Vec2 revolute_error(const JointPose& pose) { return pose.gap; }
[[nodiscard]] inline Vec2 prismatic_error(const JointPose& pose) { return {dot(perp(pose.axis), pose.gap), pose.angle}; }

void distance_rows(const JointRecord& joint, const JointPose& pose, JointRows& out);
void revolute_holds(const JointPose& pose, JointRows& out); ///< what is held alone
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

/// The coordinate that the axis moves: a length, an angle, a translation.
[[nodiscard]] float axis_coordinate(const JointRecord& joint, const JointPose& pose);

} // namespace carom::internal
