// The rows of joints of all kinds, and the properties that follow from them. The file of a kind (kinds/) says which lines and angles it holds and frees;
// what is made of them, rows or errors alone, is up to the receiver.

#include "dynamics/solver/joint/joint_rows.h"

#include "dynamics/solver/joint/kinds/distance.h"
#include "dynamics/solver/joint/kinds/prismatic.h"
#include "dynamics/solver/joint/kinds/revolute.h"
#include "dynamics/solver/joint/kinds/spring.h"
#include "dynamics/solver/joint/kinds/weld.h"

#include <algorithm>

namespace carom::internal {

namespace {

// Receives the equations of a joint and makes rows of them.
class RowMaker
{
public:
    RowMaker(const JointPose& pose, JointRows& out) : m_pose(pose), m_out(out) { m_out.held_count = m_out.axis_count = 0; }

    void hold_x(float error) { hold({.d = {1, 0}, .arm_a = -m_pose.ra.y, .arm_b = -m_pose.rb.y, .error = error}); }
    void hold_y(float error) { hold({.d = {0, 1}, .arm_a = m_pose.ra.x, .arm_b = m_pose.rb.x, .error = error}); }
    void hold_line(Vec2 d, float error) { hold(line_row(d, m_pose, error)); }
    void hold_carried(Vec2 d, float error) { hold(carried(d, error)); }
    void hold_angle(float error) { hold(angle(error)); }
    void free_line(int number, const AxisActs& acts, Vec2 d, float coordinate)
    {
        free(number, acts, line_row(d, m_pose, coordinate));
    }
    void free_carried(int number, const AxisActs& acts, Vec2 d, float coordinate) { free(number, acts, carried(d, coordinate)); }
    void free_angle(int number, const AxisActs& acts, float coordinate) { free(number, acts, angle(coordinate)); }

private:
    // Along a direction that turns with body a, whose lever arm reaches to anchor b.
    [[nodiscard]] JointRow carried(Vec2 d, float error) const
    {
        return {.d = d, .arm_a = cross(m_pose.ra + m_pose.gap, d), .arm_b = cross(m_pose.rb, d), .error = error};
    }
    [[nodiscard]] static JointRow angle(float error) { return {.arm_a = 1, .arm_b = 1, .error = error, .is_angle = true}; }

    void hold(const JointRow& row) { m_out.held[m_out.held_count++] = row; }
    void free(int number, const AxisActs& acts, const JointRow& row)
    {
        if (acts.any())
            m_out.axis[m_out.axis_count++] = {.row = row, .acts = acts, .number = number};
    }

    const JointPose& m_pose;
    JointRows& m_out;
};

// Receives the same and keeps errors and coordinates.
class ErrorMaker
{
public:
    explicit ErrorMaker(RowErrors& out) : m_next(out.data()) {}

    void hold_x(float error) { *m_next++ = error; }
    void hold_y(float error) { *m_next++ = error; }
    void hold_line(Vec2, float error) { *m_next++ = error; }
    void hold_carried(Vec2, float error) { *m_next++ = error; }
    void hold_angle(float error) { *m_next++ = error; }
    void free_line(int, const AxisActs& acts, Vec2, float coordinate) { free(acts, coordinate); }
    void free_carried(int, const AxisActs& acts, Vec2, float coordinate) { free(acts, coordinate); }
    void free_angle(int, const AxisActs& acts, float coordinate) { free(acts, coordinate); }

private:
    void free(const AxisActs& acts, float coordinate)
    {
        if (acts.any())
            *m_next++ = coordinate;
    }

    float* m_next;
};

template <class Equations>
void make_equations(const JointRecord& joint, const JointPose& pose, Equations&& out)
{
    switch (joint.kind)
    {
    case JointType::Spring: spring(joint, pose, out); break;
    case JointType::Distance: distance(joint, pose, out); break;
    case JointType::Revolute: revolute(joint, pose, out); break;
    case JointType::Prismatic: prismatic(joint, pose, out); break;
    case JointType::Weld: weld(pose, out); break;
    }
}

} // namespace

void place_rows(const JointRecord& joint, const JointPose& pose, JointRows& out)
{
    make_equations(joint, pose, RowMaker(pose, out));
}

RowErrors row_errors(const JointRecord& joint, const JointPose& pose)
{
    RowErrors errors{};
    make_equations(joint, pose, ErrorMaker(errors));
    return errors;
}

// |g1|² - |g0|² = (g1 + g0) · (g1 - g0), so that l1 - l0 = d · (g1 - g0) with d = (g0 + g1) / (l0 + l1). It passes through both mean anchors.
JointRow mean_line(const JointPose& before, const JointPose& after)
{
    const float sum = length(before.gap) + length(after.gap);
    const Vec2 d = sum > 0 ? (1 / sum) * (before.gap + after.gap) : Vec2{1, 0};
    return {.d = d, .arm_a = 0.5f * cross(before.ra + after.ra, d), .arm_b = 0.5f * cross(before.rb + after.rb, d)};
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
