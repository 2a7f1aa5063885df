#pragma once

// A joint in the words of the solver: rows of a Jacobian with their error at the pose the bodies have now. A joint's file says only what is
// its own; joint_solver.cpp iterates over the rows of all kinds alike (and a direct solve over a tree of joints can read the same rows).

#include "dynamics/rows.h"

namespace carom::internal {

/// What a row holds. dC = d · (vb - va) + arm_b wb - arm_a wa.
enum class RowKind : std::uint8_t
{
    Hold,  ///< C = 0
    Limit, ///< C >= 0, impulse >= 0
    Motor, ///< dC = target, |impulse| <= max
    Spring ///< soft, towards C = 0; solved with bias only
};

struct JointRow
{
    Vec2 d{};
    float arm_a = 0;
    float arm_b = 0;
    float error = 0; ///< C
    RowKind kind = RowKind::Hold;
    JointSlot slot = slot_x;
    float target = 0;      ///< motors: speed
    float max_impulse = 0; ///< motors
    float hertz = 0;       ///< softness; 0: the step's own for joints
    float damping_ratio = 0;
};

/// Held without softness of its own.
[[nodiscard]] inline bool is_rigid(const JointRow& row) { return row.kind == RowKind::Hold && row.hertz == 0; }

struct JointRows
{
    JointRow rows[6];
    int count = 0;
    bool block = false; ///< the first two rows hold a point and are solved as one

    void add(const JointRow& row) { rows[count++] = row; }
};

/// How many of a joint's rows are rigid; they come first.
[[nodiscard]] inline int held_count(const JointRows& rows)
{
    int count = 0;
    while (count < rows.count && is_rigid(rows.rows[count]))
        ++count;
    return count;
}

/// Where the joint's bodies are now, within the step.
struct JointPose
{
    Vec2 ra{}; ///< lever arms
    Vec2 rb{};
    Vec2 gap{};  ///< anchor b - anchor a
    Vec2 axis{}; ///< slider
    float angle = 0;
};

/// A joint in the solver: its record and the states of its bodies.
struct JointWork
{
    std::int32_t joint = none;
    std::int32_t a = 0;
    std::int32_t b = 0;
    SpringKick before{}; ///< of a spring, before the bodies move
    SpringKick after{};  ///< and after
    Vec2 ra0{};          ///< anchors from the centers of mass at the start of the step, world axes
    Vec2 rb0{};
    Vec2 axis0{};           ///< slider's axis at the start of the step
    Vec2 gap0{};            ///< anchor b - anchor a at the start of the step
    float angle0 = 0;       ///< joint angle at the start of the step
    float approach[2] = {}; ///< towards the lower and upper limit, before a sub-step's forces
    Vec2 force_sum{};       ///< impulses over the step
    float torque_sum = 0;
    JointPose pose{}; ///< as the bodies stand, since place_joints
    JointRows rows{};
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
[[nodiscard]] inline JointRow line_row(Vec2 d, const JointPose& pose, float error, RowKind kind, JointSlot slot)
{
    return {.d = d, .arm_a = cross(pose.ra, d), .arm_b = cross(pose.rb, d), .error = error, .kind = kind, .slot = slot};
}

/// A row of the relative angle.
[[nodiscard]] inline JointRow angle_row(float error, RowKind kind, JointSlot slot)
{
    return {.arm_a = 1, .arm_b = 1, .error = error, .kind = kind, .slot = slot};
}

/// The same row with the opposite sign, for upper limits.
[[nodiscard]] inline JointRow opposite(JointRow row, float error, JointSlot slot)
{
    row.d = -row.d;
    row.arm_a = -row.arm_a;
    row.arm_b = -row.arm_b;
    row.error = error;
    row.slot = slot;
    return row;
}

/// Limits, motor and spring along a free coordinate, common to hinges and sliders.
void add_free_axis(const JointRecord& joint, JointRow axis, float coordinate, float h, JointRows& out);

} // namespace carom::internal
