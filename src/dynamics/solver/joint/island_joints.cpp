// The passes over the joints of an island: wide joints by the SIMD kernels, the others directly or by sequential impulses.

#include "dynamics/solver/joint/island_joints.h"

#include "core/index.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/solver/joint/joint_solver.h"
#include "dynamics/solver/joint/springs.h"
#include "dynamics/state/contact_store.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

namespace carom::internal {

IslandJoints::IslandJoints(SolvedIsland& work)
    : m_work(work), m_wide(work.scratch.solver.wide_joints.data() + work.island.first_wide_joint),
      m_softness{work.view.inverse_h, make_softness(work.ctx.joint_hertz, 0, work.ctx.h)},
      m_buckets(joint_buckets(work.scratch, work.island))
{
    if (work.joints.empty())
        return;
    if (!work.output.direct)
        work.output.direct = std::make_unique<DirectSolve>();
    direct().set_wanted(work.island.policy.direct_joints);
}

void IslandJoints::begin_step()
{
    place();
    if (!m_work.joints.empty())
        take_forbidden_speeds();
    find_pulled_constraints();
    note_moved();
    note_stops(m_work.view, m_work.joints);
}

void IslandJoints::place() { place_joints(m_work.view, m_work.ctx.state, m_work.joints); }
void IslandJoints::note_limit_approach() { internal::note_limit_approach(m_work.view, m_work.ctx.state, m_work.joints); }
void IslandJoints::kick_springs_before() { internal::kick_springs_before(m_work.view, m_work.ctx.state, m_work.joints); }
void IslandJoints::kick_springs_after() { internal::kick_springs_after(m_work.view, m_work.ctx.state, m_work.joints); }

void IslandJoints::warm_start()
{
    if (!m_work.joints.empty())
        warm_start_joints(m_work.view, m_work.ctx.state, m_work.joints, direct());
    m_buckets.by_color(m_work.team, [&](int first, int last)
                       { m_kernels.warm_start_joints(m_wide + first, last - first, m_work.view.states); });
}

void IslandJoints::solve(bool use_bias, bool is_last)
{
    if (!m_work.joints.empty())
        solve_joints(m_work.view, m_work.ctx.state, m_work.joints, direct(), m_work.ctx.joint_hertz, use_bias);
    m_softness.share = is_last ? 1 : 0;
    const auto pass = use_bias ? m_kernels.solve_joints : m_kernels.relax_joints;
    m_buckets.by_color(m_work.team,
                       [&](int first, int last) { pass(m_wide + first, last - first, m_work.view.states, m_softness); });
}

void IslandJoints::bounce_off_limits(bool contacts_have_bounced)
{
    if (m_work.joints.empty())
        return;
    internal::bounce_off_limits(m_work.view, m_work.ctx.state, m_work.joints, direct(), m_work.ctx.scene.tolerances.rest_speed);
    if (are_direct() && contacts_have_bounced)
        direct().solve(false);
}

void IslandJoints::finish_substep()
{
    finish_joint_substep(m_work.view, m_work.ctx.state, m_work.joints);
    if (!m_work.joints.empty() && direct().yields())
        go_on_yielding();
}

void IslandJoints::close_gaps()
{
    if (are_direct() && direct().turns_too_far())
        internal::close_gaps(direct(), m_work.view, m_work.ctx.state, m_work.joints);
}

// Finds the contacts of jointed bodies with bodies of infinite mass. In an island with wide contact constraints, each of them gets a scalar constraint as well.
void IslandJoints::find_pulled_constraints()
{
    m_work.output.pulled_constraints.clear();
    for (const JointWork& work : m_work.joints)
    {
        for (const std::int32_t s : {work.a, work.b})
        {
            if (!m_work.is_dynamic(s) || (m_work.view.states[s].flags & body_flag::jointed) != 0)
                continue;
            m_work.view.states[s].flags |= body_flag::jointed;
            const int body = m_work.scratch.solver.state_bodies[as_index(s)];
            if (m_work.island.wide_count > 0)
                for_each_contact(m_work.ctx.state, body, [&](int contact) { add_pulled_constraint(contact, body, s); });
        }
    }
}

void IslandJoints::add_pulled_constraint(int index, int body, std::int32_t own)
{
    const Contact& contact = m_work.ctx.state.contacts[index];
    if (contact.manifold.count == 0 || is_left_out(contact))
        return;
    const std::int32_t other = state_for_constraints(m_work.ctx, m_work.island, other_body(contact, body));
    if (other == none || m_work.is_dynamic(other))
        return;
    const bool is_a = contact.body_a == body;
    m_work.output.pulled_constraints.push_back(
        prepare_constraint(m_work.ctx, index, contact.manifold, is_a ? own : other, is_a ? other : own));
}

// Impulses and velocities set by the user, new joints and new lengths may produce speeds that the joints forbid.
void IslandJoints::take_forbidden_speeds()
{
    direct().look_again();
    prepare_direct(DirectSolve::Masses::Own);
    direct().fit_springs();
    if (are_direct())
        direct().take_forbidden_speeds();
}

// A limit or an anchor that was moved since the last step shows in the joint's error.
void IslandJoints::note_moved()
{
    const float tiny = 1e-4f * m_work.ctx.scene.tolerances.slop;
    for (JointWork& work : m_work.joints)
    {
        const JointErrors errors = work.errors();
        const JointRecord& joint = m_work.ctx.state.joints[work.joint];
        for (std::size_t i = 0; joint.knows_errors && i < errors.size(); ++i)
        {
            const float moved = errors[i] - joint.left_errors[i];
            work.moved[i] = std::fabs(moved) > tiny ? moved : 0;
        }
    }
}

// Prepares the direct solve at the present pose.
void IslandJoints::prepare_direct(DirectSolve::Masses masses)
{
    if (m_work.joints.empty())
        return;
    if (m_work.island.flier_count > 0)
        direct().look_again();
    direct().prepare(m_work.view, m_work.ctx.state, m_work.joints, masses);
}

// All joints of the island yield until all of them are closed again.
void IslandJoints::go_on_yielding()
{
    const float near = m_work.ctx.h * m_work.view.push_speed;
    const auto is_closed = [&](const JointWork& work)
    { return std::ranges::all_of(work.errors(), [&](float error) { return std::fabs(error) <= near; }); };
    const bool are_closed = std::ranges::all_of(m_work.joints, is_closed);
    for (JointWork& work : m_work.joints)
        work.yields = !are_closed;
    forget_pull();
}

// The impulses of a pull into a wall are arbitrary, and a bad warm start for the next sub-step: on a long lever they turn a body faster than a sub-step
// can follow.
void IslandJoints::forget_pull()
{
    const auto is_pulled = [&](std::int32_t a, std::int32_t b)
    { return ((m_work.view.states[a].flags | m_work.view.states[b].flags) & body_flag::jointed) != 0; };
    for (const JointWork& work : m_work.joints)
    {
        forget_impulses(m_work.ctx.state.joints[work.joint]);
        for (const std::int32_t s : {work.a, work.b})
        {
            if (m_work.is_dynamic(s))
                m_work.view.states[s].flags |= body_flag::pressed;
        }
    }
    m_work.for_each_constraint(
        [&](ContactConstraint& constraint)
        {
            if (!is_pulled(constraint.a, constraint.b))
                return;
            for (ConstraintPoint& p : constraint.points)
                p.normal_impulse = p.tangent_impulse = 0;
        });
    for (WideContact& constraint :
         std::span(m_work.scratch.solver.wide_contacts.data() + m_work.island.wide_store, as_index(m_work.island.wide_count)))
    {
        for (int i = 0; i < lane_count; ++i)
        {
            if (!is_pulled(constraint.a.v[i], constraint.b.v[i]))
                continue;
            for (WidePoint& p : constraint.points)
                p.normal_impulse.v[i] = p.tangent_impulse.v[i] = 0;
        }
    }
}

} // namespace carom::internal
