// The last resort in a jam, where no impulses separate all bodies that close in on each other. Approaching bodies then go on as one rigid
// body, at speeds that conserve momentum and angular momentum: nothing in it approaches any more, and energy has only been lost.

#include "core/index.h"
#include "dynamics/continuous/impact/impact_set.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace carom::internal {

namespace {

bool may_move(const ImpactBody& b) { return b.inverse_mass_x > 0 || b.inverse_mass_y > 0 || b.inverse_inertia > 0; }

/// The motion of a rigid body, given at one of its points.
struct RigidMotion
{
    double x = 0;
    double y = 0;
    double vx = 0;
    double vy = 0;
    double w = 0;
};

} // namespace

class ImpactSet::Jam
{
public:
    explicit Jam(ImpactSet& of) : m_of(of), m_start(of.m_bodies), m_groups(of.m_bodies.size())
    {
        std::iota(m_groups.begin(), m_groups.end(), 0);
        note_free();
    }

    // False if bodies of infinite mass close in on one another.
    bool unite()
    {
        while (unite_what_approaches())
        {
            for (std::size_t i = 0; i < m_groups.size(); ++i)
            {
                if (m_groups[i] == static_cast<int>(i))
                    move_as_one(m_groups[i]);
            }
        }
        const auto approaches = [this](const ImpactRow& row) { return this->approaches(row); };
        return std::ranges::none_of(m_of.m_rows, approaches);
    }

private:
    void note_free()
    {
        for (const ImpactBody& b : m_start)
            m_is_free.push_back(b.inverse_mass_x > 0 && b.inverse_mass_y > 0 && b.inverse_inertia > 0);
        for (const ImpactRow& row : m_of.m_rows)
        {
            if (row.kind != ImpactRow::Kind::Contact)
                m_is_free[as_index(row.a)] = m_is_free[as_index(row.b)] = false;
        }
    }

    [[nodiscard]] bool approaches(const ImpactRow& row) const
    {
        return row.kind == ImpactRow::Kind::Contact && gap_rate(m_of.m_bodies, row) < -m_of.m_span.least_approach;
    }

    bool unite_what_approaches()
    {
        bool united = false;
        for (const ImpactRow& row : m_of.m_rows)
        {
            const int a = m_groups[as_index(row.a)];
            const int b = m_groups[as_index(row.b)];
            if (a == b || !approaches(row))
                continue;
            std::ranges::replace(m_groups, std::max(a, b), std::min(a, b));
            united = true;
        }
        return united;
    }

    void move_as_one(int group)
    {
        const RigidMotion motion = motion_of(group);
        for (std::size_t i = 0; i < m_groups.size(); ++i)
        {
            ImpactBody& b = m_of.m_bodies[i];
            if (m_groups[i] != group || !may_move(b))
                continue;
            const CenterPath& at = m_of.m_members[i].path.center;
            const bool follows = m_is_free[i];
            b.vx = follows ? motion.vx - motion.w * (at.y - motion.y) : 0;
            b.vy = follows ? motion.vy + motion.w * (at.x - motion.x) : 0;
            b.w = follows ? motion.w : 0;
        }
    }

    // A group moves with a member of infinite mass. It stands still with a member that can move only in part.
    [[nodiscard]] RigidMotion motion_of(int group) const
    {
        for (std::size_t i = 0; i < m_groups.size(); ++i)
        {
            const ImpactBody& b = m_start[i];
            const CenterPath& at = m_of.m_members[i].path.center;
            if (m_groups[i] == group && !m_is_free[i])
                return may_move(b) ? RigidMotion{} : RigidMotion{at.x, at.y, b.vx, b.vy, b.w};
        }
        return mean_motion(group);
    }

    [[nodiscard]] RigidMotion mean_motion(int group) const
    {
        RigidMotion m;
        double mass = 0;
        const auto each = [&](const auto& visit)
        {
            for (std::size_t i = 0; i < m_groups.size(); ++i)
            {
                if (m_groups[i] == group)
                    visit(m_start[i], m_of.m_members[i].path.center, 1 / m_start[i].inverse_mass_x);
            }
        };
        each(
            [&](const ImpactBody& b, const CenterPath& at, double of)
            {
                mass += of;
                m.x += of * at.x;
                m.y += of * at.y;
                m.vx += of * b.vx;
                m.vy += of * b.vy;
            });
        for (double* mean : {&m.x, &m.y, &m.vx, &m.vy})
            *mean /= mass;
        double inertia = 0;
        each(
            [&](const ImpactBody& b, const CenterPath& at, double of)
            {
                const double x = at.x - m.x;
                const double y = at.y - m.y;
                inertia += of * (x * x + y * y) + 1 / b.inverse_inertia;
                m.w += of * (x * b.vy - y * b.vx) + b.w / b.inverse_inertia;
            });
        m.w /= inertia;
        return m;
    }

    ImpactSet& m_of;
    std::vector<ImpactBody> m_start; ///< bodies before they were united
    std::vector<int> m_groups;       ///< by body: the first body of its group
    std::vector<bool> m_is_free;     ///< by body: neither locked nor in a joint, so any motion is allowed
};

bool ImpactSet::unite_jammed() { return Jam(*this).unite(); }

} // namespace carom::internal
