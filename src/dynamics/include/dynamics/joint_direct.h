#pragma once

// The direct solve of what joints hold, beside the row after row of joint_solver.h.

#include "dynamics/joint_bodies.h"

#include <span>
#include <vector>

namespace carom::internal {

/// All holding rows of a unit at once. Kept from step to step for its memory alone.
class DirectSolve
{
public:
    static constexpr int most_rows = 128;

    /// At the present pose. Not ready where there is nothing to hold, too much of it, or loops: then the soft rows have to do.
    void prepare(const SolverView& view, SceneState& state, std::span<const JointWork> joints);
    [[nodiscard]] bool is_ready() const { return m_ready; }
    void warm_start();
    void solve(bool use_bias);
    void keep_together(); ///< J v = 0
    /// No straight way leads to where the joints want the bodies: let them drift, then close the gaps.
    [[nodiscard]] bool turns_too_far() const { return m_turns_too_far; }
    /// Moves the bodies and leaves their velocities: one step of Newton's.
    void close_gaps();

private:
    struct Row
    {
        int joint = 0; ///< place in m_joints
        int a = 0;     ///< nodes
        int b = 0;
        JointRow row{};
    };

    /// A body that joints hold; all that do not move are one.
    struct Node
    {
        std::int32_t state = none;
        int tree = 0;      ///< the node that stands for what is connected with it
        float stretch = 0; ///< (omega h)²
        Vec2 inverse_mass{};
        float inverse_inertia = 0;
        Placement ahead{};
        Vec2 shift{}; ///< on the way to closed gaps
        float turn = 0;
    };

    [[nodiscard]] bool collect();
    [[nodiscard]] bool connect(const JointWork& work, const JointPose& pose, const JointRows& rows);
    [[nodiscard]] int node_of(std::int32_t state);
    [[nodiscard]] Node& node(int i) { return m_nodes[static_cast<std::size_t>(i)]; }
    void set_masses(Node& node) const;
    [[nodiscard]] const Row& row(int i) const { return m_rows[static_cast<std::size_t>(i)]; }
    [[nodiscard]] float& impulse_of(const Row& row) const { return m_state->joints[work(row).joint].impulses[row.row.slot]; }
    [[nodiscard]] const JointWork& work(const Row& row) const { return m_joints[static_cast<std::size_t>(row.joint)]; }

    void fill_matrix();
    [[nodiscard]] double couple(const Row& i, const Row& j);
    [[nodiscard]] double& at(int row, int column) { return m_matrix[static_cast<std::size_t>(row * m_count + column)]; }
    [[nodiscard]] bool factor();
    [[nodiscard]] double reduced(int i, int j);
    void substitute();

    [[nodiscard]] bool find_pose_ahead();
    void start_anew();
    [[nodiscard]] double largest_error() const;
    void note_speeds();
    void note_errors_ahead();
    void apply(float sign = 1);
    void push(const Row& row, float impulse);
    static void note_shift(Node& node, const JointRow& row, float arm, float impulse);
    void shift(const Node& node, float share);

    SolverView m_view{};
    SceneState* m_state = nullptr;
    std::span<const JointWork> m_joints;
    bool m_ready = false;
    bool m_turns_too_far = false;
    float m_longest_arm = 0;
    int m_count = 0;
    std::vector<Row> m_rows;
    std::vector<Node> m_nodes;
    std::vector<int> m_first; ///< column in which a row of the matrix begins
    std::vector<double> m_matrix;
    std::vector<double> m_residual;
    std::vector<double> m_impulse;
};

/// Until none is left to speak of.
void close_gaps(DirectSolve& direct, const SolverView& view, SceneState& state, std::span<JointWork> joints);

} // namespace carom::internal
