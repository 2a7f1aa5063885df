#pragma once

// The energy of bodies that joints hold together, in small units.

#include "dynamics/joint_bodies.h"

#include <array>
#include <span>

namespace carom::internal {

/// Joints that hold do no work. Over a sub-step in which nothing else acts on a tree of bodies but forces and impacts its energy is therefore
/// known, and the speeds at which its bodies move against each other are scaled to it. What is left of the error of finite steps is one of phase,
/// however fast the tree spins.
class TreeEnergy
{
public:
    static constexpr int most_bodies = 64;

    /// Before the forces of a sub-step. `bodies`: the unit's dynamic states, [first, first + count).
    TreeEnergy(const SolverView& view, const SceneState& state, std::span<const JointWork> joints, std::int32_t first,
               std::int32_t count);
    /// Around what happens in flight: energy that impacts took or gave stays so.
    void before_impacts() { add_kinetic(1); }
    void after_impacts() { add_kinetic(-1); }
    /// What a loaded contact does to its bodies is not known.
    void note_rows(std::span<const ContactRow> rows);
    /// After the relaxation. `exact`: the joints were solved to the end; else they may only have put in too much.
    void restore(bool exact);

private:
    struct Body
    {
        int tree = 0;    ///< the least body it is connected with
        Vec2 position{}; ///< at the start of the sub-step
        Rotation rotation{};
    };

    struct Tree
    {
        double lost = 0; ///< kinetic energy of the start, and what has been added since, less that of now
        bool is_joined = false;
        bool is_anchored = false;
        bool is_passive = true;  ///< nothing may do work on it but forces
        bool is_bounded = false; ///< a limit took part, which may take energy
    };

    [[nodiscard]] bool is_ours(std::int32_t state) const { return state >= m_first && state < m_first + m_count; }
    [[nodiscard]] Body& body(std::int32_t state) { return m_bodies[static_cast<std::size_t>(state - m_first)]; }
    [[nodiscard]] Tree& tree_of(std::int32_t state) { return m_trees[static_cast<std::size_t>(body(state).tree)]; }
    void connect(std::int32_t a, std::int32_t b);
    void note_joint(const JointWork& work);
    void note_limits();
    void add_kinetic(double sign);
    void add_work();
    void scale(int tree, bool exact);

    const SolverView& m_view;
    const SceneState& m_state;
    std::span<const JointWork> m_joints;
    std::int32_t m_first;
    std::int32_t m_count;
    std::array<Body, most_bodies> m_bodies{};
    std::array<Tree, most_bodies> m_trees{};
};

} // namespace carom::internal
