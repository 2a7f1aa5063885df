// One island through all its sub-steps. In every sub-step the soft constraints advance first, then the island's balls in flight through the same interval, then
// everything relaxes and bounces (restitution.cpp). In a huge island balls fly after everything has relaxed: solve_by_parts.

#include "dynamics/solver/island_solver.h"

#include "core/float4.h"
#include "core/index.h"
#include "core/trigonometry.h"
#include "dynamics/continuous/flight.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/solver/contact/coloring.h"
#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/solver/contact/partitions.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/solver/contact/prepare_wide.h"
#include "dynamics/solver/contact/restitution.h"
#include "dynamics/solver/force_laws.h"
#include "dynamics/solver/joint/joint_solver.h"
#include "dynamics/solver/joint/springs.h"
#include "dynamics/solver/simd/kernels.h"
#include "dynamics/solver/walls.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/turns.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <utility>

namespace carom::internal {

namespace {

constexpr int turns = 3;
constexpr int settle_turns = 16;
constexpr int enough_states = 256; // to share
constexpr int passes_of_deep_overlaps = 7;
constexpr float follow_turn = 0.03f; // rad

// Each new point takes over what the old one of the same feature bore; what is left over counts in the sum over the step.
void carry_points(const Manifold& old, const Manifold& fresh, ContactConstraint& constraint)
{
    ConstraintPoint points[2];
    bool taken[2] = {};
    for (int i = 0; i < fresh.count; ++i)
    {
        for (int j = 0; j < constraint.count; ++j)
        {
            const bool same = fresh.points[i].feature == old.points[j].feature || (fresh.count == 1 && constraint.count == 1);
            if (!same || taken[j])
                continue;
            points[i] = constraint.points[j];
            taken[j] = true;
            break;
        }
    }
    for (int j = 0; j < constraint.count; ++j)
    {
        if (taken[j])
            continue;
        points[0].total_impulse += constraint.points[j].total_impulse;
        points[0].total_tangent += constraint.points[j].total_tangent;
    }
    std::copy(std::begin(points), std::end(points), std::begin(constraint.points));
}

class IslandSolver
{
public:
    IslandSolver(const StepContext& ctx, const Island& island, IslandOutput& output, IslandEnergy& energy, WorkerTeam& team)
        : m_ctx(island.policy.subdivisions > 1 ? subdivided(ctx, island.policy.subdivisions) : ctx), m_scratch(ctx.scratch),
          m_island(island), m_output(output), m_energy(energy), m_team(team), m_watches_energy(island.policy.conserves_energy),
          m_view{ctx.scratch.states.data(), ctx.scratch.constants.data(), m_ctx.h, 1 / m_ctx.h, ctx.scene.tolerances.push_speed},
          m_constraints(constraints_of(ctx.scratch, island)),
          m_joints(std::span(ctx.scratch.joints)
                       .subspan(static_cast<std::size_t>(island.first_joint), static_cast<std::size_t>(island.joint_count))),
          m_wide(ctx.scratch.wide_contacts.data() + island.wide_store),
          m_notes(ctx.scratch.wide_notes.data() + island.wide_store), m_struck(ctx.scratch.struck.data() + island.wide_store),
          m_softness{m_ctx.h, 1 / m_ctx.h, m_view.push_speed, m_ctx.contact_softness, m_ctx.static_softness, m_ctx.rest_speed},
          m_wide_joints(ctx.scratch.wide_joints.data() + island.first_wide_joint),
          m_joint_softness{1 / m_ctx.h, make_softness(m_ctx.joint_hertz, 0, m_ctx.h)},
          m_may_start_by_body(island.wide_count > 0 && island.joint_count == 0 && island.wide_joint_count == 0),
          m_bins(contact_bins(m_scratch, island)), m_joint_bins(joint_bins(m_scratch, island))
    {}

    void run()
    {
        place_joints(m_view, m_ctx.state, m_joints);
        if (!m_joints.empty())
            take_forbidden_speeds();
        find_pulled_constraints();
        note_moved_joints();
        add_constraints_beyond_seams();
        for (int k = 0; k < m_ctx.substeps; ++k)
            substep(k);
        if (m_ctx.subdivisions > 1)
            scale_impulses(static_cast<float>(m_ctx.subdivisions));
    }

private:
    // Contacts of what joints connect, with what does not give way: those that stand in lanes, once more by themselves.
    void find_pulled_constraints()
    {
        m_output.pulled_constraints.clear();
        for (const JointWork& work : m_joints)
        {
            for (const std::int32_t s : {work.a, work.b})
            {
                if (!is_dynamic(s) || (m_view.states[s].flags & body_flag::jointed) != 0)
                    continue;
                m_view.states[s].flags |= body_flag::jointed;
                const int body = m_scratch.state_bodies[as_index(s)];
                if (m_island.wide_count > 0)
                    for_each_contact(m_ctx.state, body, [&](int contact) { add_pulled_constraint(contact, body, s); });
            }
        }
    }

    void add_pulled_constraint(int index, int body, std::int32_t own)
    {
        const Contact& contact = m_ctx.state.contacts[index];
        if (contact.manifold.count == 0 || is_left_out(contact))
            return;
        const std::int32_t other = state_for_constraints(m_ctx, m_island, other_body(contact, body));
        if (other == none || is_dynamic(other))
            return;
        const bool is_a = contact.body_a == body;
        m_output.pulled_constraints.push_back(
            prepare_constraint(m_ctx, index, contact.manifold, is_a ? own : other, is_a ? other : own));
    }

    [[nodiscard]] static bool is_left_out(const Contact& contact)
    {
        return (contact.flags & (contact_flag::trigger | contact_flag::passing)) != 0;
    }

    [[nodiscard]] bool is_dynamic(std::int32_t state) const { return (m_view.states[state].flags & body_flag::dynamic) != 0; }

    void add_constraints_beyond_seams()
    {
        if (!m_island.policy.recomputes_contacts)
            return;
        const SceneState& state = m_ctx.state;
        for (std::int32_t s = m_island.first_state + 1; s <= m_island.first_state + m_island.dynamic_count; ++s)
        {
            if ((m_view.states[s].flags & body_flag::flier) != 0)
                continue;
            const int body = m_scratch.state_bodies[static_cast<std::size_t>(s)];
            for (int edge = state.bodies[body].first_contact; edge != none; edge = state.contacts[edge >> 1].next[edge & 1])
                add_constraint_beyond_seam(edge >> 1, body, s);
        }
    }

    void add_constraint_beyond_seam(int index, int body, std::int32_t own)
    {
        const Contact& contact = m_ctx.state.contacts[index];
        if (contact.manifold.count > 0 || is_left_out(contact) || !may_come_to_face(contact, m_island))
            return;
        const bool is_a = contact.body_a == body;
        const std::int32_t other = state_for_constraints(m_ctx, m_island, other_body(contact, body));
        const bool is_others_too = other != none && (m_view.states[other].flags & body_flag::dynamic) != 0;
        if (other == none || (is_others_too && !is_a))
            return;
        m_output.late_constraints.push_back(
            prepare_constraint(m_ctx, index, contact.manifold, is_a ? own : other, is_a ? other : own));
        follow_closely(contact, m_island, m_output.late_constraints.back());
    }

    void substep(int k)
    {
        apply_force_laws(m_ctx, m_island, k, m_output);
        raise_fast(m_ctx, m_island, k, m_output);
        if (is_airborne())
        {
            fly_alone(k);
            return;
        }
        note_approaches();
        begin_energy();
        integrate_velocities(k);
        warm_start_all();
        predict_bends();
        if (goes_by_parts())
        {
            solve_by_parts();
            if (has_fliers())
            {
                fly(k);
                relax_struck();
            }
            bounce(k);
            finish_substep(k);
            return;
        }
        solve(true);
        if (m_watches_energy)
            note_pressed();
        integrate_positions();
        if (is_direct() && m_output.direct->turns_too_far())
            close_gaps(*m_output.direct, m_view, m_ctx.state, m_joints);
        kick_springs_after(m_view, m_ctx.state, m_joints);
        walls().guard_cores();
        if (m_island.policy.exact_impacts && has_fliers())
            relax(); // they must not meet what overlap is pushed out with
        fly(k);
        relax();
        bounce_and_restore(k);
        finish_substep(k);
    }

    // The solver has nothing of it: hinges fly with their bodies.
    [[nodiscard]] bool is_airborne() const
    {
        return m_island.flier_count == m_island.dynamic_count && m_island.state_count == m_island.dynamic_count + 1 &&
               m_constraints.empty() && m_output.late_constraints.empty() && m_island.wide_count == 0 &&
               m_island.wide_joint_count == 0 && std::ranges::none_of(fliers_of(m_scratch, m_island), &Flier::landed);
    }

    // What lands on the way is the solver's from there on.
    void fly_alone(int k)
    {
        advance_fliers(m_ctx, m_island, k, m_output, m_team);
        if (!is_airborne())
        {
            begin_energy();
            relax();
            bounce_and_restore(k);
        }
        finish_substep(k);
    }

    // And how far joints and contacts are from what they are to hold: they do work on the way there.
    void begin_energy()
    {
        if (!m_watches_energy)
            return;
        for_each_constraint(
            [this](ContactConstraint& constraint)
            {
                for (int i = 0; i < constraint.count; ++i)
                    constraint.points[i].separation_before = constraint_separation(m_view, constraint, constraint.points[i]);
            });
        for (JointWork& work : m_joints)
            work.errors_before = work.errors();
        m_energy.begin(m_view, m_ctx, m_joints, m_island);
    }

    void bounce_and_restore(int k)
    {
        if (m_watches_energy)
            m_energy.note_load(m_constraints, late_constraints());
        const bool kicked = bounce(k);
        if (m_watches_energy && !kicked)
            m_energy.restore(is_direct());
        if (m_watches_energy && m_energy.has_held_back())
            place_joints(m_view, m_ctx.state, m_joints);
    }

    // Nothing but lanes is solved, and nothing comes between solving and relaxing. In a huge island something always flies: there it flies after both.
    [[nodiscard]] bool goes_by_parts() const
    {
        return m_island.parts > 0 && m_joints.empty() && m_island.wide_joint_count == 0 && m_constraints.empty() &&
               m_output.late_constraints.empty() && !m_island.traced && (are_many(m_island.parts) || !has_fliers());
    }

    // Each part goes from solving through its new poses to relaxing at once, while its constraints are in the cache. What crosses from part to part is solved before
    // and relaxed after.
    void solve_by_parts()
    {
        const auto solve = [this](int first, int last) { solve_lanes(first, last); };
        const auto relax = [this](int first, int last) { relax_lanes(first, last); };
        const int first_kinematic = m_island.first_state + 1 + m_island.dynamic_count;
        integrate_positions(first_kinematic, m_island.first_state + m_island.state_count);
        const auto parts =
            std::span(m_scratch.parts).subspan(as_index(m_island.first_state + 1), as_index(m_island.dynamic_count));
        const Walls walls = this->walls();
        m_bins.crossing(m_team, solve);
        m_bins.in_parts(m_team,
                        [&](int part)
                        {
                            const auto states = std::ranges::equal_range(parts, static_cast<std::uint16_t>(part));
                            const auto first = static_cast<int>(states.begin() - parts.begin()) + m_island.first_state + 1;
                            m_bins.of_part(part, solve);
                            integrate_positions(first, first + static_cast<int>(states.size()));
                            m_bins.of_part(part, [&](int begin, int end) { walls.guard_wide_cores(begin, end); });
                            m_bins.of_part(part, relax);
                        });
        m_bins.crossing(m_team, relax);
    }

    // In a huge island: what has flown into some bodies finds them relaxed already, and what has landed has constraints only now.
    void relax_struck()
    {
        std::vector<std::int32_t>& parts = m_output.struck_states;
        if (parts.empty() && late_constraints().empty())
            return;
        std::ranges::transform(parts, parts.begin(), [&](std::int32_t state) { return m_scratch.parts[as_index(state)]; });
        std::erase_if(parts, [&](std::int32_t part) { return part >= m_island.parts; }); // of what does not give way
        std::ranges::sort(parts);
        parts.erase(std::ranges::unique(parts).begin(), parts.end());
        const auto relax = [this](int first, int last)
        {
            take_from_sums(first, last);
            relax_lanes(first, last);
        };
        m_bins.crossing(m_team, relax);
        m_team.in_pieces(static_cast<int>(parts.size()), false, [&](int i) { m_bins.of_part(parts[as_index(i)], relax); });
        solve_contact_constraints(m_view, late_constraints(), false);
    }

    // What relaxing has added: it comes again.
    void take_from_sums(int first, int last) const
    {
        for (int g = first; g < last; ++g)
        {
            for (WidePoint& p : std::span(m_wide[g].points).first(as_index(m_notes[g].count)))
            {
                for (int i = 0; i < lane_count; ++i)
                {
                    p.total_impulse.v[i] -= m_softness.share * p.normal_impulse.v[i];
                    p.total_tangent.v[i] -= m_softness.share * p.tangent_impulse.v[i];
                }
            }
        }
    }

    // Groups of one bin.
    [[nodiscard]] WideBin lanes(int first, int last) const
    {
        return {m_wide + first, m_notes + first, last - first, are_constraints_far(m_island)};
    }

    void solve_lanes(int first, int last) const { m_kernels.solve(lanes(first, last), m_view.states, m_softness); }

    void relax_lanes(int first, int last)
    {
        const float least =
            m_kernels.relax(lanes(first, last), m_view.states, m_softness, m_scratch.speeds.data(), m_struck + first);
        if (least < deep())
            std::atomic_ref(m_is_deep).store(1, std::memory_order_relaxed);
    }

    // Where many bodies overlap far, the speeds at which they are pushed out add up, and one pass takes out little of it: they would fly apart. In islands that
    // are cut into parts it would cost too much.
    void relax_deep_overlaps()
    {
        if (std::exchange(m_is_deep, 0) == 0 || m_island.parts > 0)
            return;
        for (int i = 0; i < passes_of_deep_overlaps; ++i)
        {
            take_from_sums(0, m_island.wide_count);
            m_bins.by_color(m_team, [this](int first, int last) { relax_lanes(first, last); });
            solve_contact_constraints(m_view, m_constraints, false);
            solve_contact_constraints(m_view, late_constraints(), false);
        }
        m_is_deep = 0;
    }

    // From here on overlap is pushed out as fast as allowed. No load presses anything so far into another.
    [[nodiscard]] float deep() const { return -m_view.push_speed / m_softness.contact.bias_rate; }

    void note_pressed()
    {
        for_each_constraint([](ContactConstraint& constraint) { constraint.pressed = bears_load(constraint) ? 1 : 0; });
    }

    // At the poses that have been reached: takes out the speed that pushed overlaps out.
    void relax()
    {
        refresh_constraints();
        place_joints(m_view, m_ctx.state, m_joints);
        prepare_direct(DirectSolve::Masses::Own);
        solve(false);
        relax_deep_overlaps();
    }

    [[nodiscard]] bool has_fliers() const
    {
        const std::span<const Flier> fliers = fliers_of(m_scratch, m_island);
        return std::any_of(fliers.begin(), fliers.end(), [](const Flier& f) { return !f.landed; });
    }

    void fly(int k)
    {
        if (m_island.flier_count == 0)
        {
            trace_paths(m_ctx, m_island, k, m_output);
            return;
        }
        if (m_watches_energy)
            m_energy.before_impacts();
        m_output.stopped_joints.clear();
        advance_fliers(m_ctx, m_island, k, m_output, m_team);
        if (m_watches_energy)
            m_energy.after_impacts(m_output.stopped_joints);
    }

    // What is kept for the next step's warm start is of a whole sub-step.
    void scale_impulses(float by)
    {
        for_each_constraint([by](ContactConstraint& constraint) { scale_constraint(constraint, by); });
        for (const JointWork& work : m_joints)
        {
            for (float& impulse : m_ctx.state.joints[work.joint].impulses)
                impulse *= by;
        }
    }

    [[nodiscard]] std::span<ContactConstraint> late_constraints() { return m_output.late_constraints; }

    template <class Visit>
    void for_each_constraint(const Visit& visit)
    {
        for (const std::span<ContactConstraint> constraints : {m_constraints, late_constraints()})
            std::for_each(constraints.begin(), constraints.end(), visit);
    }

    void note_approaches()
    {
        internal::note_approaches(bouncing());
        note_limit_approach(m_view, m_ctx.state, m_joints);
    }

    // v += h a, then damping. Balls in flight have their own way. Where points and normals keep through the step, all that the constraints gave to a body in the
    // last sub-step is given again at once: what warm starting adds up constraint by constraint. It is what the body's speeds are beyond those that they would be without.
    void integrate_velocities(int k)
    {
        const bool disturbed = std::exchange(m_output.disturbed, false);
        m_starts_by_body = m_may_start_by_body && k > 0 && !disturbed;
        over_states(
            [&](int i)
            {
                BodyState& s = m_view.states[i];
                const F4 now = speeds_of(s);
                store4(&m_scratch.speeds[static_cast<std::size_t>(i)].velocity.x, now);
                if (!solver_moves(s))
                    return;
                float* const unpushed = &m_scratch.unpushed[static_cast<std::size_t>(i)].velocity.x;
                const F4 next = accelerated(s, m_view.constants[i]);
                set_speeds(s, m_starts_by_body ? next + (now - load4(unpushed)) : next);
                if (m_may_start_by_body)
                    store4(unpushed, next);
            });
    }

    // Not kinematic, and not in flight.
    [[nodiscard]] static bool solver_moves(const BodyState& s)
    {
        return (s.flags & (body_flag::dynamic | body_flag::flier)) == body_flag::dynamic;
    }

    template <class Visit>
    void over_states(const Visit& visit)
    {
        over_ranges(
            [&](int first, int last)
            {
                for (int i = first; i < last; ++i)
                    visit(i);
            });
    }

    template <class Work>
    void over_ranges(const Work& work)
    {
        m_team.share(m_island.state_count, enough_states,
                     [&](int first, int last) { work(m_island.first_state + first, m_island.first_state + last); });
    }

    static_assert(sizeof(BodySpeeds) == sizeof(F4) && offsetof(BodyState, angular_velocity) == 8);

    // Velocity, angular velocity, and 0 where the flags are.
    [[nodiscard]] static F4 speeds_of(const BodyState& s) { return with_last(load4(&s.velocity.x), F4{}); }

    static void set_speeds(BodyState& s, F4 speeds) { store4(&s.velocity.x, with_last(speeds, load4(&s.velocity.x))); }

    // By a sub-step's forces and damping: v + h a, then the decay.
    [[nodiscard]] F4 accelerated(const BodyState& s, const StateConstants& c) const
    {
        static_assert(offsetof(StateConstants, angular_acceleration) == 12 && offsetof(StateConstants, acceleration) == 16);
        const F4 rest = load4(&c.acceleration.x); // acceleration, and decays of both
        const F4 masses = load4(&c.inverse_mass.x);
        const F4 acceleration = low_and_high(rest, interleaved_high(masses, masses));
        const F4 decay = interleaved_high(rest, rest);
        return decay * (speeds_of(s) + m_ctx.h * acceleration);
    }

    void warm_start_all()
    {
        kick_springs_before(m_view, m_ctx.state, m_joints);
        prepare_direct(DirectSolve::Masses::Loaded);
        if (!m_joints.empty())
            warm_start_joints(m_view, m_ctx.state, m_joints, *m_output.direct);
        if (m_starts_by_body)
            return;
        m_joint_bins.by_color(m_team, [&](int first, int last)
                              { m_kernels.warm_start_joints(m_wide_joints + first, last - first, m_view.states); });
        m_bins.by_color(m_team, [&](int first, int last) { m_kernels.warm_start(lanes(first, last), m_view.states); });
        warm_start(m_view, m_constraints);
        warm_start(m_view, late_constraints());
    }

    [[nodiscard]] DirectSolve& direct_solve()
    {
        if (!m_output.direct)
            m_output.direct = std::make_unique<DirectSolve>();
        m_output.direct->set_most_rows(m_island.policy.direct_rows);
        return *m_output.direct;
    }

    // Pushes and given velocities, new joints and new lengths may ask for speeds that joints forbid.
    void take_forbidden_speeds()
    {
        direct_solve().look_again();
        prepare_direct(DirectSolve::Masses::Own);
        direct_solve().fit_springs();
        if (is_direct())
            m_output.direct->take_forbidden_speeds();
    }

    // Whoever has moved a limit or an anchor since the last step, it shows in what the joint is off by.
    void note_moved_joints()
    {
        const float tiny = 1e-4f * m_ctx.scene.tolerances.slop;
        for (JointWork& work : m_joints)
        {
            const JointErrors errors = work.errors();
            const JointRecord& joint = m_ctx.state.joints[work.joint];
            for (std::size_t i = 0; joint.knows_errors && i < errors.size(); ++i)
            {
                const float moved = errors[i] - joint.left_errors[i];
                work.moved[i] = std::fabs(moved) > tiny ? moved : 0;
            }
        }
    }

    // At the present pose.
    void prepare_direct(DirectSolve::Masses masses)
    {
        if (m_joints.empty())
            return;
        if (m_island.flier_count > 0)
            m_output.direct->look_again();
        m_output.direct->prepare(m_view, m_ctx.state, m_joints, masses);
    }
    [[nodiscard]] bool is_direct() const { return !m_joints.empty() && m_output.direct->is_ready(); }

    // Joints have the last word over contacts, unless it leads a body into a wall.
    void solve(bool use_bias)
    {
        solve_in_turns(use_bias);
        if (!is_direct() || !has_contacts() || m_output.direct->yields())
            return;
        const float before = walls().entry();
        m_output.direct->solve(use_bias);
        if (const float after = walls().entry(); after <= m_ctx.scene.tolerances.slop || after <= before)
            return;
        m_output.direct->yield();
        if (!use_bias)
            take_from_sums(0, m_island.wide_count);
        solve_in_turns(use_bias);
    }

    [[nodiscard]] bool has_contacts() { return !m_constraints.empty() || !late_constraints().empty() || m_island.wide_count > 0; }

    // Where bodies are few, joints and contacts take turns. Contacts of a few bodies are solved until they agree: what a wall stops last still comes into its
    // neighbours, and overlap is pushed out against the forces.
    void solve_in_turns(bool use_bias)
    {
        const std::size_t contacts = m_constraints.size() + late_constraints().size();
        const bool alternate = is_direct() && contacts > 0 && m_island.wide_count == 0;
        const bool settles = m_island.policy.converges && contacts > 0 && contacts + m_joints.size() > 1;
        const int most = settles ? settle_turns : alternate ? turns : 1;
        for (int turn = 0; turn < most; ++turn)
        {
            if (settles)
                note_velocities();
            if (!m_joints.empty())
                solve_joints(m_view, m_ctx.state, m_joints, *m_output.direct, m_ctx.joint_hertz, use_bias);
            m_softness.share = m_joint_softness.share = turn + 1 == most ? 1 : 0;
            const auto joint_pass = use_bias ? m_kernels.solve_joints : m_kernels.relax_joints;
            m_joint_bins.by_color(m_team, [&](int first, int last)
                                  { joint_pass(m_wide_joints + first, last - first, m_view.states, m_joint_softness); });
            m_bins.by_color(m_team, [&](int first, int last) { use_bias ? solve_lanes(first, last) : relax_lanes(first, last); });
            if (alternate && m_output.direct->has_free_articulations())
                m_output.direct->solve_contacts(m_constraints, late_constraints(), use_bias, tiny_speed());
            else
            {
                solve_contact_constraints(m_view, m_constraints, use_bias);
                solve_contact_constraints(m_view, late_constraints(), use_bias);
            }
            if (settles && have_settled() && (!alternate || turn + 1 >= turns))
                break;
        }
    }

    struct Velocity
    {
        Vec2 linear;
        float angular;
    };

    void note_velocities()
    {
        for (int i = 0; i < m_island.dynamic_count; ++i)
        {
            const BodyState& s = m_view.states[m_island.first_state + 1 + i];
            m_velocities[static_cast<std::size_t>(i)] = {s.velocity, s.angular_velocity};
        }
    }

    [[nodiscard]] float tiny_speed() const { return 0.01f * m_ctx.scene.tolerances.slop * m_view.inverse_h; }

    // No body's speed has changed by more than a hundredth of the slop per sub-step.
    [[nodiscard]] bool have_settled() const
    {
        const float tiny = tiny_speed();
        for (int i = 0; i < m_island.dynamic_count; ++i)
        {
            const BodyState& s = m_view.states[m_island.first_state + 1 + i];
            const StateConstants& c = m_view.constants[m_island.first_state + 1 + i];
            const Velocity& old = m_velocities[static_cast<std::size_t>(i)];
            const Vec2 dv = s.velocity - old.linear;
            const float dw = s.angular_velocity - old.angular;
            const float turning = c.inverse_inertia > 0 ? dw * dw * c.inverse_mass.x / c.inverse_inertia : 0;
            if (dot(dv, dv) + turning > tiny * tiny)
                return false;
        }
        return true;
    }

    // x += h v
    void integrate_positions()
    {
        over_ranges([this](int first, int last) { integrate_positions(first, last); });
    }

    void integrate_positions(int first, int last)
    {
        while (first < last)
        {
            first += m_kernels.move(m_view.states + first, m_view.constants + first, last - first, m_ctx.h);
            const int next = std::min(first + lane_count, last);
            for (; first < next; ++first)
                integrate_position(first);
        }
    }

    void integrate_position(int i)
    {
        BodyState& s = m_view.states[i];
        if ((s.flags & body_flag::flier) != 0)
            return;
        s.delta_position += drift(m_view, i);
        if (s.angular_velocity != 0)
            turn_by(s, m_ctx.h * s.angular_velocity);
    }

    [[nodiscard]] Walls walls()
    {
        const auto cores = std::span(m_scratch.cores).subspan(as_index(m_island.first_core), as_index(m_island.core_count));
        return {m_view,
                {m_constraints, late_constraints(), m_output.pulled_constraints, {m_wide, as_index(m_island.wide_count)}, cores}};
    }

    // --- contacts in small islands: looked at anew within the step -----------------------------------------------------------------------

    [[nodiscard]] BodyPose pose_of(int body, std::int32_t state, float ahead) const
    {
        const BodySim& sim = m_ctx.state.sims[static_cast<std::size_t>(body)];
        const BodyState& s = m_scratch.states[static_cast<std::size_t>(state)];
        Rotation q = s.delta_rotation;
        if (ahead != 0 && s.angular_velocity != 0)
            q = Rotation::from_angle(ahead * s.angular_velocity) * q;
        return {sim.center + s.delta_position + ahead * s.velocity, q * sim.rotation, sim.local_center};
    }

    [[nodiscard]] Manifold manifold_of(int index, const ContactConstraint& constraint, float ahead) const
    {
        const Contact& contact = m_ctx.state.contacts[index];
        return world_manifold(m_ctx.state, contact, pose_of(contact.body_a, constraint.a, ahead),
                              pose_of(contact.body_b, constraint.b, ahead), 1e9f);
    }

    struct Facing
    {
        int contact;
        Manifold manifold;
    };

    // The contact through which the constraint's shapes face each other now: a ball that rolls over a seam changes from piece to piece.
    [[nodiscard]] Facing facing(const ContactConstraint& constraint, float ahead) const
    {
        const SceneState& state = m_ctx.state;
        Facing best{constraint.contact, manifold_of(constraint.contact, constraint, ahead)};
        const Contact& contact = state.contacts[constraint.contact];
        if (best.manifold.count == 1 || (contact.flags & contact_flag::piece) == 0)
            return best;
        const bool chain_is_a = state.shapes[contact.shape_a].owner != contact.shape_a;
        const int piece = chain_is_a ? contact.shape_a : contact.shape_b;
        const int visitor = chain_is_a ? contact.shape_b : contact.shape_a;
        for (int edge = state.bodies[state.shapes[visitor].body].first_contact; edge != none;
             edge = state.contacts[edge >> 1].next[edge & 1])
        {
            const Contact& other = state.contacts[edge >> 1];
            const int other_piece = chain_is_a ? other.shape_a : other.shape_b;
            if ((chain_is_a ? other.shape_b : other.shape_a) != visitor ||
                state.shapes[other_piece].owner != state.shapes[piece].owner)
                continue;
            const Manifold m = manifold_of(edge >> 1, constraint, ahead);
            if (m.count == 1 && (best.manifold.count != 1 || m.points[0].separation < best.manifold.points[0].separation))
                best = {edge >> 1, m};
        }
        return best;
    }

    // The true separation at the pose that the present velocities lead to, less the straight-line prediction of it.
    void predict_bends()
    {
        for_each_constraint([this](ContactConstraint& constraint) { predict_bend(constraint); });
    }

    void predict_bend(ContactConstraint& constraint) const
    {
        if (constraint.followed != 0 && is_carried(constraint))
            predict_turn(constraint);
        if (constraint.refreshed == 0 || constraint.count != 1)
            return;
        ConstraintPoint& p = constraint.points[0];
        p.predicted_bend = 0;
        const BodyState& a = m_view.states[constraint.a];
        const BodyState& b = m_view.states[constraint.b];
        const float now = constraint_separation(m_view, constraint, p);
        const float reach = m_ctx.h * (length(b.velocity - a.velocity) + std::fabs(a.angular_velocity) * length(p.ra));
        if (now > reach)
            return;
        const Manifold ahead = facing(constraint, m_ctx.h).manifold;
        if (ahead.count != 1 || dot(ahead.normal, constraint.n) < 0.5f)
            return;
        const Vec2 v = b.velocity + cross(b.angular_velocity, p.rb) - a.velocity - cross(a.angular_velocity, p.ra);
        p.predicted_bend = ahead.points[0].separation - (now + m_ctx.h * dot(v, constraint.n));
    }

    // By a kinematic body that turns.
    [[nodiscard]] bool is_carried(const ContactConstraint& constraint) const
    {
        const auto carries = [](const BodyState& s) { return (s.flags & body_flag::dynamic) == 0 && s.angular_velocity != 0; };
        return carries(m_view.states[constraint.a]) || carries(m_view.states[constraint.b]);
    }

    // Of corners and edges, to second order in the turn: points go around, and the face of a, or of b, turns meanwhile.
    void predict_turn(ContactConstraint& constraint) const
    {
        const BodyState& a = m_view.states[constraint.a];
        const BodyState& b = m_view.states[constraint.b];
        const float wa = a.angular_velocity;
        const float wb = b.angular_velocity;
        const float turning = 0.5f * m_ctx.h * m_ctx.h;
        for (int i = 0; i < constraint.count; ++i)
        {
            ConstraintPoint& p = constraint.points[i];
            const Vec2 v = b.velocity + cross(wb, p.rb) - a.velocity - cross(wa, p.ra);
            p.predicted_bend = turning * (wa * wa * dot(constraint.n, p.ra) - wb * wb * dot(constraint.n, p.rb) +
                                          (wa + wb) * dot(perp(constraint.n), v));
        }
    }

    void refresh_constraints()
    {
        for_each_constraint([this](ContactConstraint& constraint)
                            { constraint.followed != 0 ? follow(constraint) : refresh_constraint(constraint); });
    }

    // Corners and edges that have turned face each other elsewhere; what a turning body carries must not lag behind it.
    void follow(ContactConstraint& constraint)
    {
        const BodyState& a = m_view.states[constraint.a];
        const BodyState& b = m_view.states[constraint.b];
        const float least = (is_carried(constraint) ? 0.1f : 1.0f) * follow_turn;
        if (constraint.count > 0 && !has_turned(constraint.turn_a, a.delta_rotation, least) &&
            !has_turned(constraint.turn_b, b.delta_rotation, least))
            return;
        Manifold fresh = manifold_of(constraint.contact, constraint, 0);
        carry_points(m_ctx.state.contacts[constraint.contact].manifold, fresh, constraint);
        set_constraint_geometry(m_scratch, constraint, fresh);
        m_ctx.state.contacts[constraint.contact].manifold = fresh;
        impulses_of(m_ctx.state, constraint.contact) = {}; // the constraint has them
    }

    [[nodiscard]] static bool has_turned(Rotation from, Rotation to, float least)
    {
        return std::fabs(to.s - from.s) + std::fabs(to.c - from.c) > least;
    }

    void refresh_constraint(ContactConstraint& constraint)
    {
        if (constraint.refreshed == 0)
            return;
        if (constraint.count == 0)
        {
            roll_back(constraint);
            return;
        }
        const Facing now = facing(constraint, 0);
        if (now.manifold.count != 1)
            return;
        if (now.contact != constraint.contact && has_constraint(now.contact))
        {
            constraint.count = 0; // rolled over to a piece that has its own constraint
            return;
        }
        set_constraint_geometry(m_scratch, constraint, now.manifold);
        if (now.contact == constraint.contact)
            return;
        leave_color(m_ctx.state, m_ctx.state.contacts[now.contact]);
        m_ctx.state.contacts[now.contact].color =
            std::exchange(m_ctx.state.contacts[constraint.contact].color, none); // of the same bodies
        forget_impulses(m_ctx.state, constraint.contact);
        constraint.contact = now.contact;
    }

    // Onto the piece that it left before.
    void roll_back(ContactConstraint& constraint)
    {
        const Manifold now = manifold_of(constraint.contact, constraint, 0);
        if (now.count != 1)
            return;
        constraint.points[0].normal_impulse = constraint.points[0].tangent_impulse = 0;
        set_constraint_geometry(m_scratch, constraint, now);
    }

    [[nodiscard]] bool has_constraint(int contact)
    {
        const auto is_it = [&](const ContactConstraint& constraint)
        { return constraint.contact == contact && !is_dropped(constraint); };
        return std::any_of(m_constraints.begin(), m_constraints.end(), is_it) ||
               std::any_of(m_output.late_constraints.begin(), m_output.late_constraints.end(), is_it);
    }

    // --- impacts ---------------------------------------------------------------------------------------------------------------------

    [[nodiscard]] BouncingIsland bouncing() { return {m_ctx, m_island, m_output, m_view, m_may_start_by_body}; }

    // True where something kicked.
    bool bounce(int k)
    {
        const int before = m_output.bulk_impacts;
        const std::size_t kicks = m_output.kicked_shapes.size();
        internal::bounce(bouncing(), k, m_team);
        if (m_joints.empty())
            return m_output.kicked_shapes.size() != kicks;
        bounce_off_limits(m_view, m_ctx.state, m_joints, *m_output.direct, m_ctx.scene.tolerances.rest_speed);
        if (is_direct() && m_output.bulk_impacts != before)
            m_output.direct->solve(false);
        return m_output.kicked_shapes.size() != kicks;
    }

    // --- sums over the step ------------------------------------------------------------------------------------------------------------

    void finish_substep(int k)
    {
        for_each_constraint(sum_impulses);
        finish_joint_substep(m_view, m_ctx.state, m_joints);
        if (!m_joints.empty() && m_output.direct->yields())
            go_on_yielding();
        if (m_ctx.scene.def.record_substeps && (k + 1) % m_ctx.subdivisions == 0)
            record_poses(k);
    }

    // Joints yield until they are closed again.
    void go_on_yielding()
    {
        const float near = m_ctx.h * m_view.push_speed;
        const auto is_closed = [&](const JointWork& work)
        { return std::ranges::all_of(work.errors(), [&](float error) { return std::fabs(error) <= near; }); };
        const bool are_closed = std::ranges::all_of(m_joints, is_closed);
        for (JointWork& work : m_joints)
            work.yields = !are_closed;
        forget_pull();
    }

    // The loads of a pull into a wall are arbitrary and no start for the next sub-step: on a long lever they turn a body faster than a sub-step can follow.
    void forget_pull()
    {
        const auto is_pulled = [&](std::int32_t a, std::int32_t b)
        { return ((m_view.states[a].flags | m_view.states[b].flags) & body_flag::jointed) != 0; };
        for (const JointWork& work : m_joints)
        {
            forget_impulses(m_ctx.state.joints[work.joint]);
            for (const std::int32_t s : {work.a, work.b})
            {
                if (is_dynamic(s))
                    m_view.states[s].flags |= body_flag::pressed;
            }
        }
        for_each_constraint(
            [&](ContactConstraint& constraint)
            {
                if (!is_pulled(constraint.a, constraint.b))
                    return;
                for (ConstraintPoint& p : constraint.points)
                    p.normal_impulse = p.tangent_impulse = 0;
            });
        for (WideContact& constraint : std::span(m_wide, as_index(m_island.wide_count)))
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

    static void sum_impulses(ContactConstraint& constraint)
    {
        for (int i = 0; i < constraint.count; ++i)
        {
            constraint.points[i].total_impulse += constraint.points[i].normal_impulse;
            constraint.points[i].total_tangent += constraint.points[i].tangent_impulse;
        }
    }

    void record_poses(int k);

    StepContext m_ctx;
    Scratch& m_scratch;
    const Island& m_island;
    IslandOutput& m_output;
    IslandEnergy& m_energy; ///< memory that the islands of a task share
    WorkerTeam& m_team;
    bool m_watches_energy;
    SolverView m_view;
    std::span<ContactConstraint> m_constraints;
    std::span<JointWork> m_joints;
    WideContact* m_wide;
    WideContactNotes* m_notes;
    std::uint8_t* m_struck; ///< lanes of each group
    WideSoftness m_softness;
    WideJoint* m_wide_joints;
    JointSoftness m_joint_softness;
    bool m_may_start_by_body;
    bool m_starts_by_body = false; ///< in this sub-step
    int m_is_deep = 0;             ///< some overlap of lanes is pushed out as fast as allowed
    Partitions m_bins;
    Partitions m_joint_bins;
    const WideKernels& m_kernels = wide_kernels();
    std::array<Velocity, most_converging_bodies> m_velocities{}; ///< before a pass
};

void IslandSolver::record_poses(int k)
{
    for (int i = m_island.first_state; i < m_island.first_state + m_island.state_count; ++i)
    {
        const int body = m_scratch.state_bodies[static_cast<std::size_t>(i)];
        if (body != none && (m_scratch.states[static_cast<std::size_t>(i)].flags & body_flag::dynamic) != 0)
            m_output.poses.push_back({body, m_ctx.h * static_cast<float>(k + 1), pose_of(body, i, 0).frame()});
    }
}

} // namespace

void solve_island(const StepContext& ctx, const Island& island, IslandOutput& output, IslandEnergy& energy, WorkerTeam& team)
{
    IslandSolver(ctx, island, output, energy, team).run();
}

} // namespace carom::internal
