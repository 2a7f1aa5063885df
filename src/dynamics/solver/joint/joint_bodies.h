#pragma once

// The two bodies of a joint in the solver: their poses, their speed along a row, and the effect of an impulse on them.

#include "dynamics/solver/body_state.h"
#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/solver/joint/held_block.h"
#include "dynamics/solver/joint/joint_rows.h"
#include "dynamics/state/scene_data.h"

namespace carom::internal {

struct JointBodies
{
    BodyState& sa;
    BodyState& sb;
    const StateConstants& ca;
    const StateConstants& cb;

    JointBodies(const SolverView& view, const JointWork& work)
        : sa(view.states[work.a]), sb(view.states[work.b]), ca(view.constants[work.a]), cb(view.constants[work.b])
    {}

    [[nodiscard]] bool are_anchored() const
    {
        const auto stands = [](const StateConstants& c) { return c.inverse_mass == Vec2{} && c.inverse_inertia == 0; };
        return stands(ca) || stands(cb);
    }

    [[nodiscard]] float speed(const JointRow& r) const
    {
        return dot(r.d, sb.velocity - sa.velocity) + r.arm_b * sb.angular_velocity - r.arm_a * sa.angular_velocity;
    }

    // J M^-1 J'^T for two rows.
    [[nodiscard]] float couple(const JointRow& r, const JointRow& q) const
    {
        return response<float>(ca.inverse(), {r.d.x, r.d.y, r.arm_a}, {q.d.x, q.d.y, q.arm_a}, cb.inverse(), r.arm_b, q.arm_b);
    }

    [[nodiscard]] float mass(const JointRow& r) const
    {
        const float k = couple(r, r);
        return k > 0 ? 1 / k : 0;
    }

    [[nodiscard]] HeldBlock block(std::span<const JointRow> held) const
    {
        return {held.size(), [&](std::size_t i, std::size_t j) { return couple(held[i], held[j]); }};
    }

    /// Applies an impulse along an axis together with the reaction of the held rows. Soft held rows give only a share of that reaction.
    void apply_along(const JointAxis& axis, std::span<const JointRow> held, float impulse, float share = 1) const
    {
        apply(axis.row, impulse);
        for (std::size_t i = 0; i < held.size(); ++i)
            apply(held[i], share * impulse * axis.reaction[i]);
    }

    void apply(const JointRow& r, float impulse) const
    {
        sa.velocity.x -= ca.inverse_mass.x * impulse * r.d.x;
        sa.velocity.y -= ca.inverse_mass.y * impulse * r.d.y;
        sa.angular_velocity -= ca.inverse_inertia * impulse * r.arm_a;
        sb.velocity.x += cb.inverse_mass.x * impulse * r.d.x;
        sb.velocity.y += cb.inverse_mass.y * impulse * r.d.y;
        sb.angular_velocity += cb.inverse_inertia * impulse * r.arm_b;
    }
};

[[nodiscard]] inline AxisImpulses axis_impulses(const JointRecord& joint, int number)
{
    const auto in = [&](JointSlot slot) { return static_cast<double>(joint.impulses[slot_of_axis(number, slot)]); };
    return {in(slot_spring), in(slot_motor), in(slot_lower), in(slot_upper)};
}

[[nodiscard]] inline float axis_impulse(const JointRecord& joint, int number)
{
    return static_cast<float>(axis_impulses(joint, number).sum());
}

inline void set_axis_impulses(JointRecord& joint, int number, const AxisImpulses& to)
{
    const auto in = [&](JointSlot slot) -> float& { return joint.impulses[slot_of_axis(number, slot)]; };
    in(slot_spring) = static_cast<float>(to.spring);
    in(slot_motor) = static_cast<float>(to.motor);
    in(slot_lower) = static_cast<float>(to.lower);
    in(slot_upper) = static_cast<float>(to.upper);
}

/// The impulse of a row of the joint over the last sub-step.
[[nodiscard]] inline float impulse_of(const JointRecord& joint, const JointRows& rows, int row)
{
    return row < rows.held_count ? joint.impulses[slot_held + row] : axis_impulse(joint, rows.axis[row - rows.held_count].number);
}

/// Whether the joint is a hinge to the world whose body is in flight about it. Such a hinge is enforced by flight, not by the solver.
[[nodiscard]] inline bool is_in_flight(const SolverView& view, const JointWork& work)
{
    return ((view.states[work.a].flags | view.states[work.b].flags) & body_flag::flier) != 0;
}

/// The displacement of a body since the start of the step.
struct Placement
{
    Vec2 shift{};
    Rotation turn{};
    std::int32_t turns = 0; ///< whole turns in addition
};
/// Where the present velocities lead the body by the end of the sub-step.
[[nodiscard]] Placement placed_ahead(const SolverView& view, std::int32_t state);
/// The angle is computed only if the joint needs it.
[[nodiscard]] JointPose joint_pose(const JointWork& work, const Placement& a, const Placement& b);
[[nodiscard]] JointPose present_pose(const SolverView& view, const JointWork& work);

/// Computes the poses and rows at the present poses of the bodies; for springs, the poses only.
void place_joints(const SolverView& view, const SceneState& state, std::span<JointWork> joints);

/// Computes the inverse mass along each axis, and how the held rows react to an impulse along it.
void weigh_rows(const JointBodies& bodies, JointRows& rows);

} // namespace carom::internal
