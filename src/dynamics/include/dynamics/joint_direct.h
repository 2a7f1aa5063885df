#pragma once

// The direct solve of what joints hold, beside the row after row of joint_solver.h.

#include "dynamics/joint_bodies.h"
#include "dynamics/joint_forest.h"
#include "dynamics/joint_matrix.h"

#include <span>
#include <vector>

namespace carom::internal {

/// All holding rows of a unit at once. Kept from step to step for its memory, and for the forest where the joints are the same.
class DirectSolve
{
public:
    static constexpr int most_rows = 128;

    /// Once a step, and after a body has taken off or landed: who hangs on whom is found anew.
    void look_again() { m_looks_again = true; }
    /// At the present pose. Not ready where there is nothing to hold, too much of it, or loops: then the soft rows have to do.
    void prepare(const SolverView& view, SceneState& state, std::span<JointWork> joints);
    [[nodiscard]] bool is_ready() const { return m_ready; }
    void warm_start();
    void solve(bool use_bias);
    void keep_together(); ///< J v = 0
    /// The same for speeds that others than the solver have given the bodies, before any load is known.
    void take_forbidden_speeds();
    /// No straight way leads to where the joints want the bodies: let them drift, then close the gaps.
    [[nodiscard]] bool turns_too_far() const { return m_turns_too_far; }
    /// Moves the bodies and leaves their velocities: one step of Newton's.
    void close_gaps();

private:
    /// What of a row stands in J, and so in the matrix.
    struct Line
    {
        Vec2 d{};
        float arm_a = 0;
        float arm_b = 0;
    };

    /// A joint, in the order of the forest.
    struct Held
    {
        std::size_t joint = 0; ///< place in m_joints
        int rows = 0;
        int up = JointForest::ground; ///< nodes: towards the root, and what hangs on that
        int down = 0;
        int a = 0; ///< the same by the joint's own order
        int b = 0;
        Line lines[2];
        const JointWork* work = nullptr;
        JointRecord* record = nullptr;

        [[nodiscard]] bool take_lines();
        [[nodiscard]] float& impulse(int row) const;
        [[nodiscard]] RowPair impulses() const;
        void add(const RowPair& change) const;
        void note_blow(JointWork& told, const RowPair& impulse) const;
    };

    /// A body that joints hold; all that do not move are one.
    struct Node
    {
        std::int32_t state = none;
        float stretch = 0; ///< (omega h)²
        Placement ahead{};
        Triple shift{}; ///< on the way to closed gaps
    };

    [[nodiscard]] bool find_forest();
    [[nodiscard]] std::int32_t moving(std::int32_t state) const;
    void lay_out();
    [[nodiscard]] bool place();
    void fill_jacobian(const Held& held, JointJacobian& jacobian) const;
    void note_stretch(const Held& held);
    [[nodiscard]] Triple inverse_mass(const Node& node) const;
    [[nodiscard]] Node& node(int i) { return m_nodes[static_cast<std::size_t>(i)]; }

    [[nodiscard]] bool find_pose_ahead();
    void note_speeds();
    void note_errors_ahead();
    [[nodiscard]] Placement ahead_of(int node, std::int32_t state) const;
    [[nodiscard]] double largest_error() const;
    void find_impulses();
    void apply(double sign = 1);
    void start_anew();
    void push(std::size_t joint, const RowPair& impulse);
    void push(int node, const Triple& momentum);
    void note_shift(int node, const Triple& momentum);
    void shift(const Node& node, double share);

    SolverView m_view{};
    SceneState* m_state = nullptr;
    std::span<JointWork> m_joints;
    bool m_looks_again = true;
    bool m_is_forest = false; ///< and not too large
    bool m_ready = false;
    bool m_turns_too_far = false;
    float m_longest_arm = 0;

    std::vector<JointForest::Link> m_found;
    std::vector<JointForest::Link> m_links; ///< of the forest
    bool m_has_loops = false;               ///< then there is none
    JointForest m_forest;
    JointMatrix m_matrix;
    bool m_is_new = false;     ///< the forest: nothing stands in the matrix
    bool m_is_regular = false; ///< the matrix

    std::vector<Held> m_held;
    std::vector<JointJacobian> m_jacobians;
    std::vector<RowPair> m_residual; ///< speeds, by joint
    std::vector<RowPair> m_impulse;
    std::vector<Node> m_nodes;
    std::vector<Triple> m_masses; ///< inverse
};

/// Until none is left to speak of.
void close_gaps(DirectSolve& direct, const SolverView& view, SceneState& state, std::span<JointWork> joints);

} // namespace carom::internal
