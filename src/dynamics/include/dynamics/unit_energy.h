#pragma once

// The energy of a small unit over a sub-step.

#include "dynamics/joint_bodies.h"

#include <array>
#include <span>

namespace carom::internal {

/// Joints that hold and surfaces that stand still do no work. The energy of bodies that hang or lean together may therefore not rise by more than
/// forces, springs and impacts give, and does not fall either where joints alone hold them: the speeds at which they move against each other
/// are scaled to it. What is left of the error of finite steps is one of phase.
class UnitEnergy
{
public:
    static constexpr int most_bodies = 64;

    /// Before the forces of a sub-step. Dynamic states are [first, first + count).
    void begin(const SolverView& view, const SceneState& state, std::span<const JointWork> joints, std::int32_t first,
               std::int32_t count, float slop);
    /// Around what happens in flight: energy that impacts took or gave stays so.
    void before_impacts() { add_kinetic(-1); }
    void after_impacts();
    /// After the relaxation: joints and contacts that bear something make groups.
    void note_load(std::span<const ContactRow> rows, std::span<const ContactRow> late_rows);
    /// At the end. `exact`: the joints were solved to the end; else they may only have put in too much.
    void restore(bool exact);

private:
    struct Body
    {
        double missing = 0; ///< energy: what there was and has been added since, less what there is
        double first = 0;   ///< what there was
        Vec2 position{};    ///< at the start of the sub-step
        Rotation rotation{};
        int group = 0;     ///< the least body it is connected with
        bool flew = false; ///< at the start of the sub-step
    };

    struct Group
    {
        double missing = 0;
        double first = 0;
        double push_out = 0;
        bool touches = false;
        bool is_joined = false;   ///< by joints or contacts
        bool is_anchored = false; ///< to what does not move
        bool is_passive = true;   ///< nothing may do work on it but forces and springs
        bool may_lose = false;    ///< contacts, limits, dampers
    };

    [[nodiscard]] bool is_ours(std::int32_t state) const { return state >= m_first && state < m_first + m_count; }
    [[nodiscard]] Body& body(std::int32_t state) { return m_bodies[static_cast<std::size_t>(state - m_first)]; }
    [[nodiscard]] Group& group_of(std::int32_t state) { return m_groups[static_cast<std::size_t>(body(state).group)]; }
    [[nodiscard]] bool flies(std::int32_t state) const { return (m_view.states[state].flags & body_flag::flier) != 0; }
    void connect(std::int32_t a, std::int32_t b);
    void join(std::int32_t own, std::int32_t other);
    void note_joint(const JointWork& work);
    void connect_rows(std::span<const ContactRow> rows);
    void note_rows(std::span<const ContactRow> rows);
    void note_row(const ContactRow& row);
    void add_kinetic(double sign);
    void add_work();
    void add_springs(double sign);
    void scale(int group, bool exact);

    SolverView m_view{};
    const SceneState* m_state = nullptr;
    std::span<const JointWork> m_joints;
    float m_slop = 0;
    std::int32_t m_first = 0;
    std::int32_t m_count = 0;
    std::array<Body, most_bodies> m_bodies;
    std::array<Group, most_bodies> m_groups;
};

} // namespace carom::internal
