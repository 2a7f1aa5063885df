// Bounces of contacts whose bodies are joined: a blow acts through the joints of both bodies at the moment of the impact, also where the joints hang on
// something immovable and where both bodies belong to one articulation. A struck point is to separate at a given speed and gives no more back than it has
// taken; others may only push.

#include "dynamics/solver/joint/direct/direct_solver.h"

#include "core/index.h"

#include <algorithm>
#include <utility>

namespace carom::internal {

namespace {

constexpr int bounce_rounds = 4;  // in which motors and limits may change what they bear
constexpr int bounce_sweeps = 64; // over all contacts
constexpr float distinct = 1e-4f;

} // namespace

void DirectSolve::bounce_contacts(std::span<const ContactBounce> bounces, float tiny)
{
    for (int round = 0; round < bounce_rounds; ++round)
    {
        begin_pushes();
        for (const ContactBounce& bounce : bounces)
            m_contacts.push_back(
                {bounce.constraint, side_of(bounce.constraint->a, Anchored::Too), side_of(bounce.constraint->b, Anchored::Too)});
        float first = 0;
        for (int sweep = 0; sweep < bounce_sweeps; ++sweep)
        {
            m_largest_push = 0;
            for (std::size_t i = 0; i < bounces.size(); ++i)
                bounce_contact(m_contacts[i], bounces[i]);
            first = sweep == 0 ? m_largest_push : first;
            if (m_largest_push < tiny)
                break;
        }
        for (const Articulation& articulation : m_articulations)
            take_pushes(articulation);
        report_answers();
        if (first < tiny)
            return;
        solve(false);
    }
}

// Two points at once: a bar that lands flat bounces flat.
void DirectSolve::bounce_contact(const Contact& contact, const ContactBounce& bounce)
{
    ContactConstraint& constraint = *contact.constraint;
    PushedLine lines[2];
    float lacks[2] = {}; // speed
    const float least[2] = {bounce.wanted[0] > 0 ? 0 : bounce.stopped[0], bounce.wanted[1] > 0 ? 0 : bounce.stopped[1]};
    bool is_idle = true;
    const auto lack = [&](int i) { return bounce.wanted[i] - constraint_speed(m_view, constraint, constraint.points[i]); };
    for (int i = 0; i < constraint.count; ++i)
    {
        lacks[i] = lack(i);
        is_idle &= !bounce.answers[i] || (constraint.points[i].normal_impulse <= least[i] && lacks[i] <= 0);
    }
    if (is_idle)
        return;
    for (int i = 0; i < constraint.count; ++i)
    {
        const ConstraintPoint& p = constraint.points[i];
        const Vec2 n = constraint.n;
        if (bounce.answers[i])
            lines[i] = pushed_line(contact, as_triple(-n, -cross(p.ra, n)), as_triple(n, cross(p.rb, n)));
    }
    const auto give = [&](int i, float impulse)
    {
        float& given = constraint.points[i].normal_impulse;
        push_whole(lines[i], impulse - std::exchange(given, impulse));
    };
    const auto now = [&](int i) { return constraint.points[i].normal_impulse; };
    if (lines[0].mass > 0 && lines[1].mass > 0)
    {
        const float k11 = 1 / lines[0].mass;
        const float k22 = 1 / lines[1].mass;
        const auto k12 = static_cast<float>(mobility(contact, lines[0], lines[1]));
        const float det = k11 * k22 - k12 * k12;
        const float first = now(0) + (k22 * lacks[0] - k12 * lacks[1]) / det;
        const float second = now(1) + (k11 * lacks[1] - k12 * lacks[0]) / det;
        if (det > distinct * k11 * k22 && first >= least[0] && second >= least[1])
        {
            give(0, first);
            give(1, second);
            return;
        }
    }
    for (int i = 0; i < constraint.count; ++i)
    {
        if (lines[i].mass > 0)
            give(i, std::max(now(i) + lines[i].mass * lack(i), least[i]));
    }
}

// Impacts, not loads: the answers of held rows are no part of the warm start.
void DirectSolve::report_answers()
{
    for (const Item& item : m_items)
    {
        for (int r = 0; r < item.held; ++r)
            m_joints[item.joint].add(item.row(r), static_cast<float>(m_answered[as_index(item.first_row + r)]));
    }
    answer_along_axes();
}

} // namespace carom::internal
