// One island through all its sub-steps; islands in free fall, and those that fly a whole step at once, do not come here (solve_islands.cpp). There are three
// ways through a sub-step:
//   advance_airborne       every body of the island flies; what lands is relaxed
//   advance_by_partition   all constraints are in lanes, and nothing flies or the island is huge: each partition is solved, moved and relaxed while in the cache
//   advance                solve with bias, move, fly, relax
// then restitution, and sums over the step. Terms: a core is half of the inside of a body, which must not come into a wall; joints yield where a wall holds what they pull.

#include "dynamics/solver/island_solver.h"

#include "core/index.h"
#include "dynamics/continuous/flight.h"
#include "dynamics/forces/force_laws.h"
#include "dynamics/solver/bounce/bounce_limit.h"
#include "dynamics/solver/bounce/restitution.h"
#include "dynamics/solver/contact/contact_passes.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/solver/contact/recomputed_contacts.h"
#include "dynamics/solver/integrate.h"
#include "dynamics/solver/joint/island_joints.h"
#include "dynamics/solver/solved_island.h"
#include "dynamics/state/scene_data.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace carom::internal {

namespace {

constexpr int passes_in_turns = 3; // alternating between joints and contacts
constexpr int most_passes = 16;    // until contacts converge

// Finds whether passes over an island's contacts still change its speeds.
class Convergence
{
public:
    explicit Convergence(const SolvedIsland& work) : m_work(work) {}

    void begin_pass()
    {
        for (std::int32_t i = m_first; i < m_end; ++i)
        {
            const BodyState& s = m_work.view.states[i];
            before(i) = {s.velocity, s.angular_velocity};
        }
    }

    // A hundredth of the slop per sub-step.
    [[nodiscard]] float tiny_speed() const { return 0.01f * m_work.ctx.scene.tolerances.slop * m_work.view.inverse_h; }

    // Before `least` passes, another one must change next to nothing: arches sway for ever with what passes leave, unless it is damped.
    [[nodiscard]] bool is_reached(int pass, int least) const
    {
        const bool damps_rest = m_work.island.policy.caches_manifolds;
        const float share = pass >= least ? 1 : damps_rest ? 0.02f : 0.003f;
        return changes_less_than(share * tiny_speed());
    }

private:
    [[nodiscard]] bool changes_less_than(float tiny) const
    {
        for (std::int32_t i = m_first; i < m_end; ++i)
        {
            const BodyState& s = m_work.view.states[i];
            const StateConstants& c = m_work.view.constants[i];
            const Vec2 dv = s.velocity - before(i).velocity;
            const float dw = s.angular_velocity - before(i).angular_velocity;
            const float turning = c.inverse_inertia > 0 ? dw * dw * c.inverse_mass.x / c.inverse_inertia : 0;
            if (dot(dv, dv) + turning > tiny * tiny)
                return false;
        }
        return true;
    }

    [[nodiscard]] BodySpeeds& before(std::int32_t state) const
    {
        return m_work.scratch.solver.speeds_before_pass[as_index(state)];
    }

    const SolvedIsland& m_work;
    const std::int32_t m_first = m_work.island.first_state + 1;
    const std::int32_t m_end = m_first + m_work.island.dynamic_count;
};

class IslandSolver
{
public:
    IslandSolver(const StepContext& ctx, const Island& island, IslandOutput& output, IslandEnergy& energy, WorkerTeam& team)
        : m_work(ctx, island, output, team), m_contacts(m_work), m_recomputed(m_work), m_joints(m_work), m_energy(energy),
          m_convergence(m_work), m_policy(island.policy)
    {}

    void run()
    {
        m_joints.begin_step();
        m_recomputed.add_constraints_beyond_seams();
        for (int k = 0; k < m_work.ctx.substeps; ++k)
            substep(k);
        if (m_work.ctx.subdivisions > 1)
            scale_impulses(static_cast<float>(m_work.ctx.subdivisions));
    }

private:
    void substep(int k)
    {
        apply_force_laws(m_work.ctx, m_work.island, k, m_work.output);
        take_off_fast_movers(m_work.ctx, m_work.island, k, m_work.output);
        if (is_airborne())
        {
            advance_airborne(k);
            return;
        }
        note_approaches(bouncing());
        m_carries_approaches_on = true;
        find_drifts();
        m_joints.note_limit_approach();
        begin_energy();
        integrate_velocities(m_work, m_contacts.begin_substep(k));
        warm_start();
        m_recomputed.predict_curvatures();
        if (goes_by_partition())
            advance_by_partition(k);
        else
            advance(k);
        bounce(k);
        finish_substep(k);
    }

    // Free articulations whose joints are solved directly drift along parabolas until a contact bears a load or may be reached.
    void find_drifts()
    {
        if (!m_work.island.all_direct || m_work.island.wide_count > 0 || !m_work.has_contacts())
            return;
        for (int i = m_work.island.first_state + 1; i <= m_work.island.first_state + m_work.island.dynamic_count; ++i)
        {
            BodyState& s = m_work.view.states[i];
            if ((s.flags & body_flag::flier) == 0 && m_joints.direct().is_in_free_articulation(i))
                s.flags |= body_flag::unbound;
        }
        const auto bind = [this](std::int32_t state) { m_work.view.states[state].flags &= ~body_flag::unbound; };
        m_work.for_each_constraint(
            [&](const ContactConstraint& constraint)
            {
                if (!bears_load(constraint) && !may_meet(constraint))
                    return;
                bind(constraint.a);
                bind(constraint.b);
            });
    }

    // Within this sub-step, as far as the present speeds tell.
    [[nodiscard]] bool may_meet(const ContactConstraint& constraint) const
    {
        const StateConstants* of = m_work.view.constants;
        const float gain = m_work.ctx.h * dot(constraint.n, of[constraint.a].acceleration - of[constraint.b].acceleration);
        const auto comes_near = [&](const ConstraintPoint& p)
        {
            return constraint_separation(m_work.view, constraint, p) <
                   m_work.ctx.h * (gain - constraint_speed(m_work.view, constraint, p));
        };
        return std::ranges::any_of(std::span(constraint.points).first(as_index(constraint.count)), comes_near);
    }

    void advance(int k)
    {
        solve(true);
        note_pressed();
        integrate_positions(m_work);
        m_joints.close_gaps();
        m_joints.kick_springs_after();
        m_contacts.walls().guard_cores();
        if (m_policy.exact_impacts && m_work.has_fliers())
            relax(); // fliers must not meet the speed that pushes overlaps out
        fly(k);
        relax();
    }

    // True if all constraints are in lanes, and nothing comes between solving and relaxing.
    // In a huge island some body always flies: there, flight comes after both.
    [[nodiscard]] bool goes_by_partition() const
    {
        const Island& island = m_work.island;
        return island.partitions > 0 && m_policy.passes == 1 && m_work.joints.empty() && island.wide_joint_count == 0 &&
               m_work.constraints.empty() && m_work.late_constraints().empty() && !island.traced &&
               (exceeds_shared_cache(island.partitions) || !m_work.has_fliers());
    }

    void advance_by_partition(int k)
    {
        m_contacts.solve_by_partition();
        if (!m_work.has_fliers())
            return;
        fly(k);
        m_contacts.relax_struck();
    }

    // True if the whole island flies and the solver has nothing to do: hinges fly with their bodies.
    [[nodiscard]] bool is_airborne() const
    {
        const Island& island = m_work.island;
        return island.flier_count == island.dynamic_count && island.state_count == island.dynamic_count + 1 &&
               !m_work.has_contacts() && island.wide_joint_count == 0 &&
               std::ranges::none_of(fliers_of(m_work.scratch, island), &Flier::landed);
    }

    // A body that lands on its path belongs to the solver from there on.
    void advance_airborne(int k)
    {
        advance_fliers(m_work.ctx, m_work.island, k, m_work.output, m_work.team);
        if (!is_airborne())
        {
            begin_energy();
            relax();
            bounce(k);
        }
        finish_substep(k);
    }

    void fly(int k)
    {
        if (m_work.island.flier_count == 0)
        {
            trace_paths(m_work.ctx, m_work.island, k, m_work.output);
            return;
        }
        if (m_policy.conserves_energy)
            m_energy.before_impacts();
        m_work.output.stopped_joints.clear();
        advance_fliers(m_work.ctx, m_work.island, k, m_work.output, m_work.team);
        if (m_policy.conserves_energy)
            m_energy.after_impacts(m_work.output.stopped_joints);
    }

    // --- passes -----------------------------------------------------------------------------------------------------------------------

    void warm_start()
    {
        m_joints.kick_springs_before();
        m_joints.prepare_direct(DirectSolve::Masses::Loaded);
        m_joints.warm_start();
        m_contacts.warm_start();
    }

    // Joints have the last word over contacts, unless that leads a body into a wall.
    void solve(bool use_bias)
    {
        solve_in_turns(use_bias);
        if (!m_joints.are_direct() || !m_work.has_contacts() || m_joints.direct().yields())
            return;
        const float before = m_contacts.walls().entry();
        m_joints.direct().solve(use_bias);
        if (const float after = m_contacts.walls().entry(); after <= m_work.ctx.scene.tolerances.slop || after <= before)
            return;
        m_joints.direct().yield();
        if (!use_bias)
            m_contacts.take_from_sums();
        solve_in_turns(use_bias);
    }

    // With few bodies, joints and contacts alternate. Small islands have several passes over contacts, and those of a few bodies are solved until they
    // converge: a body that a wall stops last still stops its neighbors, and overlap is pushed out against the forces.
    void solve_in_turns(bool use_bias)
    {
        const std::size_t contacts = m_work.constraints.size() + m_work.late_constraints().size();
        const bool alternates = m_joints.are_direct() && contacts > 0 && m_work.island.wide_count == 0;
        const bool affect_each_other =
            m_work.has_contacts() && (m_work.island.wide_count > 0 || contacts + m_work.joints.size() > 1 || has_two_points());
        const int several = affect_each_other ? std::max(m_policy.passes, alternates ? passes_in_turns : 1) : 1;
        const int most = affect_each_other && m_policy.converges ? most_passes : several;
        const bool may_end =
            most > 1 && m_work.island.wide_joint_count == 0; // hinges in lanes add to their sums in the last pass
        for (int pass = 1; pass <= most; ++pass)
        {
            if (may_end)
                m_convergence.begin_pass();
            m_joints.solve(use_bias, pass == most);
            if (std::exchange(m_carries_approaches_on, false))
            {
                carry_approaches_on(bouncing());
                m_kinetic_before = 0;
                note_kinetic();
            }
            m_contacts.solve_wide(use_bias, pass > 1);
            if (alternates && m_joints.direct().has_free_articulations())
                m_joints.direct().solve_contacts(m_work.constraints, m_work.late_constraints(), use_bias,
                                                 m_convergence.tiny_speed());
            else
                m_contacts.solve_others(use_bias);
            if (may_end && m_convergence.is_reached(pass, several))
                break;
        }
    }

    // Friction couples the two points of a contact.
    [[nodiscard]] bool has_two_points() const
    {
        return std::ranges::any_of(m_work.constraints, [](const ContactConstraint& constraint) { return constraint.count == 2; });
    }

    // Works at the poses that have been reached: removes the speed that pushed overlaps out.
    void relax()
    {
        note_kinetic();
        m_recomputed.recompute();
        m_joints.place();
        m_joints.prepare_direct(DirectSolve::Masses::Own);
        solve(false);
        m_contacts.relax_deep_overlaps();
    }

    // --- impacts and energy -----------------------------------------------------------------------------------------------------------

    [[nodiscard]] BouncingIsland bouncing()
    {
        const bool through_joints = m_joints.are_direct() && !m_joints.direct().yields() && m_work.island.wide_count == 0;
        return {m_work.ctx,
                m_work.island,
                m_work.output,
                m_work.view,
                through_joints ? &m_joints.direct() : nullptr,
                m_kinetic_before,
                m_contacts.notes_bodies()};
    }

    void bounce(int k)
    {
        if (m_policy.conserves_energy)
            m_energy.note_load(m_work.constraints, m_work.late_constraints());
        const int impacts = m_work.output.bulk_impacts;
        const std::size_t kicks = m_work.output.kicked_shapes.size();
        internal::bounce(bouncing(), k, m_work.team);
        m_joints.bounce_off_limits(m_work.output.bulk_impacts != impacts);
        const bool kicked = m_work.output.kicked_shapes.size() != kicks;
        if (m_policy.conserves_energy)
            restore_energy(kicked);
    }

    // The energy that a bounce may not exceed. A contact may have stopped its bodies before, on the way.
    void note_kinetic()
    {
        if (m_joints.are_direct() && m_work.has_contacts())
            m_kinetic_before = std::max(m_kinetic_before, kinetic_energy(m_work.view, m_work.island));
    }

    void restore_energy(bool kicked)
    {
        if (!kicked)
            m_energy.restore(m_joints.are_direct());
        if (m_energy.has_cut_speeds())
            m_joints.place();
    }

    // Also notes the errors of joints and contacts: constraints do work while they correct these.
    void begin_energy()
    {
        if (!m_policy.conserves_energy)
            return;
        m_work.for_each_constraint(
            [this](ContactConstraint& constraint)
            {
                for (int i = 0; i < constraint.count; ++i)
                    constraint.points[i].separation_before = constraint_separation(m_work.view, constraint, constraint.points[i]);
            });
        for (JointWork& work : m_work.joints)
            work.errors_before = work.errors();
        m_energy.begin(m_work.view, m_work.ctx, m_work.joints, m_work.island);
    }

    void note_pressed()
    {
        if (m_policy.conserves_energy)
            m_work.for_each_constraint([](ContactConstraint& constraint)
                                       { constraint.pressed = bears_load(constraint) ? 1 : 0; });
    }

    // --- sums over the step -----------------------------------------------------------------------------------------------------------

    void finish_substep(int k)
    {
        m_work.for_each_constraint([](ContactConstraint& constraint) { add_to_sums(constraint, 1); });
        m_joints.finish_substep();
        if (m_work.ctx.scene.def.record_substeps && (k + 1) % m_work.ctx.subdivisions == 0)
            record_poses(k);
    }

    // Impulses that are kept for the next step's warm starting are those of a whole sub-step.
    void scale_impulses(float by)
    {
        m_work.for_each_constraint([by](ContactConstraint& constraint) { scale_constraint(constraint, by); });
        for (const JointWork& work : m_work.joints)
        {
            for (float& impulse : m_work.ctx.state.joints[work.joint].impulses)
                impulse *= by;
        }
    }

    void record_poses(int k)
    {
        for (int i = m_work.island.first_state; i < m_work.island.first_state + m_work.island.state_count; ++i)
        {
            const int body = m_work.scratch.solver.state_bodies[as_index(i)];
            if (body != none && m_work.is_dynamic(i))
                m_work.output.poses.push_back(
                    {body, m_work.ctx.h * static_cast<float>(k + 1), m_work.pose_of(body, i, 0).frame()});
        }
    }

    SolvedIsland m_work;
    ContactPasses m_contacts;
    RecomputedContacts m_recomputed;
    IslandJoints m_joints;
    IslandEnergy& m_energy; ///< memory that the islands of a task share
    Convergence m_convergence;
    const IslandPolicy& m_policy;
    double m_kinetic_before = 0;
    bool m_carries_approaches_on = false; ///< until joints have first been solved in the sub-step
};

} // namespace

void solve_island(const StepContext& ctx, const Island& island, IslandOutput& output, IslandEnergy& energy, WorkerTeam& team)
{
    IslandSolver(ctx, island, output, energy, team).run();
}

} // namespace carom::internal
