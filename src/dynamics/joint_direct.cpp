// Hinges of a small unit, all at once. One after the other they never agree: a double pendulum loses 6 % of its energy in a minute.
//
//   C_i = gap of hinge i at the pose that the present velocities lead to
//   sum over j of J_i M^-1 J_j^T lambda_j = -C_i / h,  two Newton passes; in the relaxation J v = 0 at the pose reached
//
// Not for all: loops make the system singular, and a load that stretches a body between its hinges makes it swing like a taut string, with
// omega² = f · r / I for the pull f at the arm r, which a sub-step can follow only while omega h is below 1. Soft rows take those.

#include "dynamics/joint_direct.h"

#include "dynamics/scene_data.h"

#include <array>
#include <cmath>

namespace carom::internal {

namespace {

constexpr int most_hinges = 8;
constexpr int most_rows = 2 * most_hinges;
constexpr float most_stretch = 1; // (omega h)²

struct Hinge
{
    std::int32_t joint = none;
    std::int32_t a = 0;
    std::int32_t b = 0;
    Vec2 ra{}; ///< now
    Vec2 rb{};
    double residual[2] = {};
};

/// A body that the hinges hold; all that do not move are one.
struct Node
{
    std::int32_t state = none;
    int tree = 0;      ///< the node that stands for what is connected with it
    float stretch = 0; ///< (omega h)²
};

class System
{
public:
    System(const SolverView& view, SceneState& state, std::span<const JointWork> joints)
        : m_view(view), m_state(state), m_joints(joints)
    {}

    /// False where there are no hinges, too many, loops, or too much load.
    bool prepare()
    {
        for (const JointWork& work : m_joints)
        {
            if (!is_hinge(work))
                continue;
            if (m_count == most_hinges)
                return false;
            const Hinge h = hinge(work);
            if (!connect(h))
                return false;
            m_hinges[static_cast<std::size_t>(m_count++)] = h;
        }
        for (int i = 0; i < m_nodes; ++i)
        {
            if (node(i).stretch > most_stretch)
                return false;
        }
        fill_matrix();
        return m_count > 0 && factor();
    }

    void solve(bool use_bias)
    {
        for (int pass = 0; pass < (use_bias ? 2 : 1); ++pass)
        {
            note_residuals(use_bias);
            substitute();
            apply();
        }
    }

private:
    [[nodiscard]] bool is_hinge(const JointWork& work) const
    {
        const std::uint32_t flags = m_view.states[work.a].flags | m_view.states[work.b].flags;
        return m_state.joints[work.joint].kind == JointType::Revolute && (flags & body_flag::flier) == 0;
    }

    [[nodiscard]] Hinge hinge(const JointWork& work) const
    {
        return {work.joint, work.a, work.b, rotate(m_view.states[work.a].delta_rotation, work.ra0),
                rotate(m_view.states[work.b].delta_rotation, work.rb0)};
    }

    // False where the two were connected already: a loop.
    bool connect(const Hinge& h)
    {
        const JointRecord& joint = m_state.joints[h.joint];
        const Vec2 pull{joint.impulses[slot_x], joint.impulses[slot_y]}; // on b, over a sub-step
        const int a = node_of(h.a);
        const int b = node_of(h.b);
        node(a).stretch -= m_view.h * m_view.constants[h.a].inverse_inertia * dot(pull, h.ra);
        node(b).stretch += m_view.h * m_view.constants[h.b].inverse_inertia * dot(pull, h.rb);
        const int old = node(a).tree;
        const int joined = node(b).tree;
        for (int i = 0; i < m_nodes; ++i)
        {
            if (node(i).tree == old)
                node(i).tree = joined;
        }
        return old != joined;
    }

    Node& node(int i) { return m_bodies[static_cast<std::size_t>(i)]; }

    int node_of(std::int32_t state)
    {
        const bool moves = (m_view.states[state].flags & body_flag::dynamic) != 0;
        const std::int32_t key = moves ? state : none;
        int i = 0;
        while (i < m_nodes && node(i).state != key)
            ++i;
        if (i == m_nodes)
            m_bodies[static_cast<std::size_t>(m_nodes++)] = {key, i, 0};
        return i;
    }

    // --- the matrix -----------------------------------------------------------------------------------------------------------------

    double& at(int row, int column) { return m_matrix[static_cast<std::size_t>(row * most_rows + column)]; }

    void fill_matrix()
    {
        for (int i = 0; i < m_count; ++i)
        {
            for (int j = 0; j <= i; ++j)
                fill_block(i, j);
        }
    }

    void fill_block(int i, int j)
    {
        const Hinge& p = m_hinges[static_cast<std::size_t>(i)];
        const Hinge& q = m_hinges[static_cast<std::size_t>(j)];
        at(2 * i, 2 * j) = at(2 * i, 2 * j + 1) = at(2 * i + 1, 2 * j) = at(2 * i + 1, 2 * j + 1) = 0;
        if (p.a == q.a)
            add_body(i, j, p.a, p.ra, q.ra, 1);
        if (p.b == q.b)
            add_body(i, j, p.b, p.rb, q.rb, 1);
        if (p.a == q.b)
            add_body(i, j, p.a, p.ra, q.rb, -1);
        if (p.b == q.a)
            add_body(i, j, p.b, p.rb, q.ra, -1);
    }

    void add_body(int i, int j, std::int32_t body, Vec2 ri, Vec2 rj, double sign)
    {
        const Vec2 m = m_view.constants[body].inverse_mass;
        const auto w = static_cast<double>(m_view.constants[body].inverse_inertia);
        const auto times = [](float x, float y) { return static_cast<double>(x) * static_cast<double>(y); };
        at(2 * i, 2 * j) += sign * (static_cast<double>(m.x) + w * times(ri.y, rj.y));
        at(2 * i, 2 * j + 1) -= sign * w * times(ri.y, rj.x);
        at(2 * i + 1, 2 * j) -= sign * w * times(ri.x, rj.y);
        at(2 * i + 1, 2 * j + 1) += sign * (static_cast<double>(m.y) + w * times(ri.x, rj.x));
    }

    // Cholesky in place; false where hinges say the same thing twice (loops).
    bool factor()
    {
        for (int i = 0; i < 2 * m_count; ++i)
        {
            for (int j = 0; j < i; ++j)
                at(i, j) = reduced(i, j) / at(j, j);
            const double diagonal = at(i, i);
            const double rest = reduced(i, i);
            if (!(rest > 1e-7 * diagonal))
                return false;
            at(i, i) = std::sqrt(rest);
        }
        return true;
    }

    double reduced(int i, int j)
    {
        double sum = at(i, j);
        for (int m = 0; m < j; ++m)
            sum -= at(i, m) * at(j, m);
        return sum;
    }

    void substitute()
    {
        const int n = 2 * m_count;
        for (int i = 0; i < n; ++i)
        {
            double sum = -m_hinges[static_cast<std::size_t>(i / 2)].residual[i % 2];
            for (int m = 0; m < i; ++m)
                sum -= at(i, m) * m_impulse[static_cast<std::size_t>(m)];
            m_impulse[static_cast<std::size_t>(i)] = sum / at(i, i);
        }
        for (int i = n - 1; i >= 0; --i)
        {
            double sum = m_impulse[static_cast<std::size_t>(i)];
            for (int m = i + 1; m < n; ++m)
                sum -= at(m, i) * m_impulse[static_cast<std::size_t>(m)];
            m_impulse[static_cast<std::size_t>(i)] = sum / at(i, i);
        }
    }

    // --- errors and impulses ----------------------------------------------------------------------------------------------------------

    void note_residuals(bool use_bias)
    {
        int i = 0;
        for (const JointWork& work : m_joints)
        {
            if (!is_hinge(work))
                continue;
            Hinge& h = m_hinges[static_cast<std::size_t>(i++)];
            const Vec2 r = use_bias ? m_view.inverse_h * gap_ahead(work) : speed_of_gap(h);
            h.residual[0] = static_cast<double>(r.x);
            h.residual[1] = static_cast<double>(r.y);
        }
    }

    [[nodiscard]] Vec2 speed_of_gap(const Hinge& h) const
    {
        const BodyState& a = m_view.states[h.a];
        const BodyState& b = m_view.states[h.b];
        return b.velocity + cross(b.angular_velocity, h.rb) - a.velocity - cross(a.angular_velocity, h.ra);
    }

    [[nodiscard]] Vec2 gap_ahead(const JointWork& work) const
    {
        const auto anchor_shift = [&](std::int32_t state, Vec2 arm)
        {
            const BodyState& s = m_view.states[state];
            const Rotation q = Rotation::from_angle(m_view.h * s.angular_velocity) * s.delta_rotation;
            return s.delta_position + m_view.h * s.velocity + (rotate(q, arm) - arm);
        };
        return work.gap0 + anchor_shift(work.b, work.rb0) - anchor_shift(work.a, work.ra0);
    }

    void apply()
    {
        for (int i = 0; i < m_count; ++i)
        {
            const Hinge& h = m_hinges[static_cast<std::size_t>(i)];
            const Vec2 impulse{static_cast<float>(m_impulse[static_cast<std::size_t>(2 * i)]),
                               static_cast<float>(m_impulse[static_cast<std::size_t>(2 * i + 1)])};
            apply_impulse(m_view.states[h.b], m_view.constants[h.b], h.rb, impulse);
            apply_impulse(m_view.states[h.a], m_view.constants[h.a], h.ra, -impulse);
            m_state.joints[h.joint].impulses[slot_x] += impulse.x;
            m_state.joints[h.joint].impulses[slot_y] += impulse.y;
        }
    }

    const SolverView& m_view;
    SceneState& m_state;
    std::span<const JointWork> m_joints;
    int m_count = 0;
    int m_nodes = 0;
    std::array<Hinge, most_hinges> m_hinges;
    std::array<Node, most_rows> m_bodies;
    std::array<double, most_rows * most_rows> m_matrix;
    std::array<double, most_rows> m_impulse;
};

} // namespace

bool solve_hinges(const SolverView& view, SceneState& state, std::span<const JointWork> joints, bool use_bias)
{
    if (joints.empty())
        return false;
    System system(view, state, joints);
    if (!system.prepare())
        return false;
    system.solve(use_bias);
    return true;
}

} // namespace carom::internal
