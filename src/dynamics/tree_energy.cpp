#include "dynamics/tree_energy.h"

#include <algorithm>
#include <cmath>

namespace carom::internal {

namespace {

double as_double(float x) { return static_cast<double>(x); }

// What is locked has no mass to speak of: it does not move.
double inverse(float x) { return x > 0 ? 1 / as_double(x) : 0; }

double square(double x) { return x * x; }

/// Velocity of the common center of mass, axis by axis: a locked axis has none.
struct Drift
{
    double mass_x = 0;
    double mass_y = 0;
    double px = 0;
    double py = 0;

    void add(const BodyState& s, const StateConstants& c)
    {
        mass_x += inverse(c.inverse_mass.x);
        mass_y += inverse(c.inverse_mass.y);
        px += inverse(c.inverse_mass.x) * as_double(s.velocity.x);
        py += inverse(c.inverse_mass.y) * as_double(s.velocity.y);
    }
    [[nodiscard]] double vx() const { return mass_x > 0 ? px / mass_x : 0; }
    [[nodiscard]] double vy() const { return mass_y > 0 ? py / mass_y : 0; }
};

// Twice the kinetic energy of motion against (vx, vy).
double twice_kinetic(const BodyState& s, const StateConstants& c, double vx, double vy)
{
    return inverse(c.inverse_mass.x) * square(as_double(s.velocity.x) - vx) +
           inverse(c.inverse_mass.y) * square(as_double(s.velocity.y) - vy) +
           inverse(c.inverse_inertia) * square(as_double(s.angular_velocity));
}

bool decays(const StateConstants& c) { return c.linear_decay != 1 || c.angular_decay != 1; }

// Motors, springs and soft holds do work.
bool is_passive(const JointRecord& joint) { return joint.kind != JointType::Spring && joint.hertz == 0 && !joint.enable_motor; }

} // namespace

TreeEnergy::TreeEnergy(const SolverView& view, const SceneState& state, std::span<const JointWork> joints, std::int32_t first,
                       std::int32_t count)
    : m_view(view), m_state(state), m_joints(joints), m_first(first), m_count(std::min(count, most_bodies))
{
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        const BodyState& s = m_view.states[i];
        body(i) = {i - m_first, s.delta_position, s.delta_rotation};
    }
    for (const JointWork& work : m_joints)
        connect(work.a, work.b);
    for (const JointWork& work : m_joints)
        note_joint(work);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (decays(m_view.constants[i]) || (m_view.states[i].flags & body_flag::flier) != 0)
            tree_of(i).is_passive = false;
    }
    add_kinetic(1);
}

void TreeEnergy::connect(std::int32_t a, std::int32_t b)
{
    if (!is_ours(a) || !is_ours(b))
        return;
    const int old = std::max(body(a).tree, body(b).tree);
    const int joined = std::min(body(a).tree, body(b).tree);
    for (std::int32_t i = 0; i < m_count; ++i)
    {
        Body& other = m_bodies[static_cast<std::size_t>(i)];
        if (other.tree == old)
            other.tree = joined;
    }
}

void TreeEnergy::note_joint(const JointWork& work)
{
    for (const auto& [own, other] : {std::pair{work.a, work.b}, std::pair{work.b, work.a}})
    {
        if (!is_ours(own))
            continue;
        Tree& tree = tree_of(own);
        tree.is_joined = true;
        if (is_ours(other))
            continue;
        const BodyState& anchor = m_view.states[other];
        tree.is_anchored = true;
        tree.is_passive &= anchor.velocity == Vec2{} && anchor.angular_velocity == 0;
    }
    if (!is_passive(m_state.joints[work.joint]) && is_ours(work.a))
        tree_of(work.a).is_passive = false;
    if (!is_passive(m_state.joints[work.joint]) && is_ours(work.b))
        tree_of(work.b).is_passive = false;
}

void TreeEnergy::note_rows(std::span<const ContactRow> rows)
{
    for (const ContactRow& row : rows)
    {
        bool is_loaded = false;
        for (int i = 0; i < row.count; ++i)
            is_loaded |= row.points[i].normal_impulse > 0;
        for (const std::int32_t s : {row.a, row.b})
        {
            if (is_loaded && is_ours(s))
                tree_of(s).is_passive = false;
        }
    }
}

void TreeEnergy::note_limits()
{
    for (const JointWork& work : m_joints)
    {
        const JointRecord& joint = m_state.joints[work.joint];
        if (joint.impulses[slot_lower] == 0 && joint.impulses[slot_upper] == 0)
            continue;
        for (const std::int32_t s : {work.a, work.b})
        {
            if (is_ours(s))
                tree_of(s).is_bounded = true;
        }
    }
}

void TreeEnergy::add_kinetic(double sign)
{
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
        tree_of(i).lost += 0.5 * sign * twice_kinetic(m_view.states[i], m_view.constants[i], 0, 0);
}

// Forces are even over the sub-step: they work along the way that was gone, however it bent.
void TreeEnergy::add_work()
{
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        const BodyState& s = m_view.states[i];
        const StateConstants& c = m_view.constants[i];
        const Vec2 way = s.delta_position - body(i).position;
        const Rotation turn = s.delta_rotation * carom::inverse(body(i).rotation);
        tree_of(i).lost += inverse(c.inverse_mass.x) * as_double(c.acceleration.x) * as_double(way.x) +
                           inverse(c.inverse_mass.y) * as_double(c.acceleration.y) * as_double(way.y) +
                           inverse(c.inverse_inertia) * as_double(c.angular_acceleration) * as_double(turn.s);
    }
}

void TreeEnergy::restore(bool exact)
{
    note_limits();
    add_work();
    add_kinetic(-1);
    for (int t = 0; t < m_count; ++t)
    {
        const Tree& tree = m_trees[static_cast<std::size_t>(t)];
        if (tree.is_joined && tree.is_passive)
            scale(t, exact && !tree.is_bounded);
    }
}

// What is free moves on with its center of mass; what hangs on the world has no motion of its own.
void TreeEnergy::scale(int tree, bool exact)
{
    const Tree& t = m_trees[static_cast<std::size_t>(tree)];
    Drift drift;
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (body(i).tree == tree && !t.is_anchored)
            drift.add(m_view.states[i], m_view.constants[i]);
    }
    double inner = 0;
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        if (body(i).tree == tree)
            inner += 0.5 * twice_kinetic(m_view.states[i], m_view.constants[i], drift.vx(), drift.vy());
    }
    if (!(inner > 0) || (!exact && t.lost >= 0))
        return;
    const double by = std::sqrt(std::max(inner + t.lost, 0.0) / inner);
    const auto change = static_cast<float>(std::min(by, 2.0) - 1);
    for (std::int32_t i = m_first; i < m_first + m_count; ++i)
    {
        BodyState& s = m_view.states[i];
        if (body(i).tree != tree)
            continue;
        s.velocity += change * (s.velocity - Vec2{static_cast<float>(drift.vx()), static_cast<float>(drift.vy())});
        s.angular_velocity += change * s.angular_velocity;
    }
}

} // namespace carom::internal
