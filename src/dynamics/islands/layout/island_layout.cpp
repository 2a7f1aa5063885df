// Assigns slots to all that an island contains, side by side: its states, copies of the kinematic bodies it meets, its constraints (constraint_slots.cpp) and
// its joints. States are filled here, on all threads. Constraints and joints are filled in island_constraints.cpp, just before the island is solved.

#include "dynamics/islands/layout/island_layout.h"

#include "core/grow.h"
#include "core/index.h"
#include "core/task_pool.h"
#include "dynamics/forces/force_laws.h"
#include "dynamics/islands/island_graph.h"
#include "dynamics/islands/layout/constraint_slots.h"
#include "dynamics/solver/contact/partitions.h"
#include "dynamics/solver/contact/prepare.h"
#include "dynamics/solver/contact/prepare_wide.h"
#include "dynamics/solver/joint/joint_solver.h"
#include "dynamics/state/contact_store.h"
#include "dynamics/state/turns.h"
#include "dynamics/task_sizes.h"

#include <algorithm>
#include <bit>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

constexpr std::int32_t places_per_task = 512;

class IslandLayout
{
public:
    explicit IslandLayout(StepContext& ctx) : m_ctx(ctx), m_state(ctx.state), m_scratch(ctx.scratch) {}

    // --- slots of states --------------------------------------------------------------------------------------------------------------

    void place_states()
    {
        m_scratch.solver.state_bodies.clear();
        m_scratch.solver.state_of.assign(m_state.awake_bodies.size(), none);
        m_scratch.layout.flier_seeds.clear();
        set_size(m_scratch.layout.joint_states, m_scratch.graph.solved_joints.size());
        for (Island& island : m_scratch.solver.islands)
            place_states_of(island);
        set_size(m_scratch.solver.states, m_scratch.solver.state_bodies.size());
        set_size(m_scratch.solver.constants, m_scratch.solver.state_bodies.size());
        set_size(m_scratch.flight.flier_of_state, m_scratch.solver.state_bodies.size());
        set_size(m_scratch.flight.versions, m_scratch.solver.state_bodies.size());
    }

    void fill_states()
    {
        run_tasks(m_ctx.scene.def.tasks, state_tasks(), [&](int task) { fill_some_states(task); });
    }

    // These tasks run in parallel: none reads what another writes.
    void fill_states_and_place_constraints_and_joints()
    {
        run_tasks(m_ctx.scene.def.tasks, 2 + state_tasks(),
                  [&](int task)
                  {
                      if (task == 0)
                          place_constraints_of_small_islands(m_ctx);
                      else if (task == 1)
                          place_joints();
                      else
                          fill_some_states(task - 2);
                  });
        place_constraints_of_large_islands(m_ctx);
        for (Island& island : m_scratch.solver.islands)
            let_drift(island);
        bind_where(
            [&](std::size_t s)
            {
                const int body = m_scratch.solver.state_bodies[s];
                return m_scratch.layout.bound_by_joint[s] != 0 || (body != none && colors_of(m_state, body) != 0);
            });
    }

    // --- fliers and laws --------------------------------------------------------------------------------------------------------------

    void add_fliers()
    {
        set_size(m_scratch.flight.fliers, m_scratch.layout.flier_seeds.size());
        set_size(m_scratch.flight.event_times, m_scratch.flight.fliers.size());
        set_size(m_scratch.flight.first_of_events, 2 * m_scratch.flight.fliers.size());
        set_size(m_scratch.flight.reaches, m_scratch.flight.fliers.size());
        const auto count = static_cast<std::int32_t>(m_scratch.flight.fliers.size());
        run_tasks(m_ctx.scene.def.tasks, tasks_for(count),
                  [&](int task)
                  {
                      for_items(
                          task, count, [](const Island& island) { return island.first_flier; },
                          [&](const StepContext& island_ctx, const Island&, std::int32_t i) { add_flier(island_ctx, i); });
                  });
    }

    void add_laws()
    {
        m_scratch.solver.laws.clear();
        for (Island& island : m_scratch.solver.islands)
        {
            island.first_law = static_cast<std::int32_t>(m_scratch.solver.laws.size());
            for (std::int32_t s = island.first_state + 1;
                 m_ctx.scene.law_count > 0 && s <= island.first_state + island.dynamic_count; ++s)
            {
                const StateConstants& c = m_scratch.solver.constants[as_index(s)];
                if (force_law_of(m_ctx, m_scratch.solver.state_bodies[as_index(s)]) != nullptr)
                    m_scratch.solver.laws.push_back({s, c.angular_acceleration, c.acceleration});
            }
            island.law_count = static_cast<std::int32_t>(m_scratch.solver.laws.size()) - island.first_law;
        }
    }

    // Sizes the arrays that island_constraints.cpp fills.
    void make_room()
    {
        set_size(m_scratch.solver.constraints, m_scratch.layout.constraint_edges.size());
        set_size(m_scratch.solver.joints, m_scratch.layout.joints_outside_lanes.size());
        set_size(m_scratch.solver.wide_joints, as_index(m_blocks));
    }

    // A state that was bound when the constraints were placed is still bound.
    void bind_as_before()
    {
        bind_where([&](std::size_t s) { return m_scratch.cached_graph.bound[s] != 0; });
    }

    void count()
    {
        for (const Island& island : m_scratch.solver.islands)
            m_ctx.report.colors = std::max(m_ctx.report.colors, static_cast<int>(island.colors));
    }

private:
    [[nodiscard]] static int tasks_for(std::int32_t items) { return (items + places_per_task - 1) / places_per_task; }

    // Clears body_flag::unbound, on all threads.
    template <class IsBound>
    void bind_where(const IsBound& is_bound)
    {
        for_each_in_chunks(m_ctx.scene.def.tasks, m_scratch.solver.states.size(), places_per_task,
                           [&](std::size_t s)
                           {
                               if (is_bound(s))
                                   m_scratch.solver.states[s].flags &= ~body_flag::unbound;
                           });
    }

    [[nodiscard]] int state_tasks() const { return tasks_for(static_cast<std::int32_t>(m_scratch.solver.state_bodies.size())); }

    void fill_some_states(int task)
    {
        for_items(
            task, static_cast<std::int32_t>(m_scratch.solver.state_bodies.size()),
            [](const Island& island) { return island.first_state; },
            [&](const StepContext& island_ctx, const Island& island, std::int32_t i) { fill_state(island_ctx, island, i); });
    }

    // Visits the items of a task, with the step context of each item's island. Items are sorted by island.
    template <class First, class Visit>
    void for_items(int task, std::int32_t count, const First& first_of, const Visit& visit)
    {
        const std::vector<Island>& islands = m_scratch.solver.islands;
        const std::int32_t begin = task * places_per_task;
        const std::int32_t end = std::min(begin + places_per_task, count);
        auto island = std::upper_bound(islands.begin(), islands.end(), begin,
                                       [&](std::int32_t i, const Island& u) { return i < first_of(u); }) -
                      1;
        for (std::int32_t i = begin; i < end; ++island)
        {
            const std::int32_t last = island + 1 != islands.end() ? std::min(end, first_of(*(island + 1))) : end;
            if (last <= i)
                continue;
            const StepContext island_ctx = step_of(m_ctx, *island);
            for (; i < last; ++i)
                visit(island_ctx, *island, i);
        }
    }

    // The first state stands for every body that does not move, so that islands share nothing. Dynamic bodies follow, sorted by plane cell, then copies of
    // kinematic ones.
    void place_states_of(Island& island)
    {
        island.first_state = add_state(none);
        island.first_flier = static_cast<std::int32_t>(m_scratch.layout.flier_seeds.size());
        for (std::int32_t i = island.first_body; i < island.first_body + island.dynamic_count; ++i)
        {
            const std::int32_t place = m_scratch.graph.solved_bodies[as_index(i)];
            const int body = m_state.awake_bodies[as_index(place)];
            m_scratch.solver.state_of[as_index(place)] = add_state(body);
            seed_flier(island, place);
        }
        island.flier_count = static_cast<std::int32_t>(m_scratch.layout.flier_seeds.size()) - island.first_flier;
        m_ctx.report.flight_bodies += island.policy.free_fall ? island.dynamic_count : 0;
        copy_kinematic_bodies(island);
        island.state_count = static_cast<std::int32_t>(m_scratch.solver.state_bodies.size()) - island.first_state;
    }

    std::int32_t add_state(int body)
    {
        m_scratch.solver.state_bodies.push_back(body);
        return static_cast<std::int32_t>(m_scratch.solver.state_bodies.size()) - 1;
    }

    void seed_flier(const Island& island, std::int32_t place)
    {
        if (island.policy.free_fall)
            return;
        const std::int32_t mode = m_scratch.graph.flight_mode[as_index(place)];
        const std::int32_t could = m_scratch.graph.could_fly[as_index(place)];
        const int body = m_state.awake_bodies[as_index(place)];
        const std::int32_t s = m_scratch.solver.state_of[as_index(place)];
        if (mode != solver_owned)
        {
            ++m_ctx.report.flight_bodies;
            if (mode != free_flight)
                forget_impulses(m_state.joints[mode]);
            m_scratch.layout.flier_seeds.push_back({s, body, mode, false});
        }
        else if (could != solver_owned && may_take_off(place, could))
        {
            m_scratch.layout.flier_seeds.push_back({s, body, could, true});
        }
    }

    // Only a flier or a force law makes a body fast enough to take off within the step.
    [[nodiscard]] bool may_take_off(std::int32_t place, std::int32_t mode) const
    {
        return m_scratch.graph.may_be_struck[as_index(place)] != 0 || mode != free_flight ||
               force_law_of(m_ctx, m_state.awake_bodies[as_index(place)]) != nullptr;
    }

    // Kinematic bodies are copied into every island that they meet: their path is a function of time alone, and islands then share nothing that is written. A
    // flier may land on a kinematic body.
    void copy_kinematic_bodies(const Island& island)
    {
        const auto index = static_cast<std::int32_t>(&island - m_scratch.solver.islands.data());
        for (const KinematicMeeting& m :
             std::ranges::equal_range(m_scratch.graph.meetings_with_kinematic, index, {}, &KinematicMeeting::island))
            static_cast<void>(state_for(island, m_state.awake_bodies[as_index(m.place)]));
        for (std::int32_t i = island.first_joint_edge; i < island.first_joint_edge + island.joint_edge_count; ++i)
        {
            const JointEdge& j = m_scratch.graph.solved_joints[as_index(i)];
            const std::int32_t a = state_at(island, j.a);
            m_scratch.layout.joint_states[as_index(i)] = {a, state_at(island, j.b)};
        }
        if (!m_scratch.graph.has_kinematic)
            return;
        for (std::int32_t i = island.first_flier; i < island.first_flier + island.flier_count; ++i)
            copy_those_near(island, m_scratch.layout.flier_seeds[as_index(i)].body);
        for (std::int32_t s = 1; island.policy.recomputes_contacts && s <= island.dynamic_count; ++s)
            copy_those_near(island, m_scratch.solver.state_bodies[as_index(island.first_state + s)]);
    }

    void copy_those_near(const Island& island, int body)
    {
        for (const int index : contacts_of(m_state, body))
        {
            const int other = other_body(m_state.contacts[index], body);
            if (m_state.bodies[other].type == BodyType::Kinematic)
                static_cast<void>(state_for(island, other));
        }
    }

    [[nodiscard]] std::int32_t state_at(const Island& island, std::int32_t place)
    {
        if (place >= 0)
            return m_scratch.solver.state_of[as_index(place)];
        return state_for(island, place == none ? none : m_state.awake_bodies[as_index(-2 - place)]);
    }

    // State of a body as seen by the constraints of this island.
    std::int32_t state_for(const Island& island, int body)
    {
        if (body == none || m_state.bodies[body].awake_index == none)
            return island.first_state;
        std::int32_t& copy = m_scratch.solver.state_of[as_index(m_state.bodies[body].awake_index)];
        if (copy < island.first_state)
            copy = add_state(body);
        return copy;
    }

    void fill_state(const StepContext& island_ctx, const Island& island, std::int32_t i)
    {
        const int body = m_scratch.solver.state_bodies[as_index(i)];
        BodyState& s = m_scratch.solver.states[as_index(i)];
        StateConstants& c = m_scratch.solver.constants[as_index(i)];
        m_scratch.flight.flier_of_state[as_index(i)] = none;
        m_scratch.flight.versions[as_index(i)] = 0;
        if (body == none)
            s = {};
        else
            start_state(m_state, body, s);
        if (!is_dynamic(island, i))
        {
            c = {};
            return;
        }
        set_constants(island_ctx, body, c);
        BodySim& sim = m_state.sims[as_index(body)];
        sim.previous_center = sim.center;
        sim.previous_rotation = sim.rotation;
        if (island.policy.wide_contacts && !island.policy.free_fall && m_state.bodies[body].first_joint == none &&
            sim.angular_velocity != 0)
            begin_at_middle(m_state, body, half_turn(sim.angular_velocity, island_ctx.dt), s);
        sim.caches_manifolds = island.policy.caches_manifolds;
        if (island.policy.free_fall)
            s.flags |= body_flag::free_fall;
    }

    void add_flier(const StepContext& island_ctx, std::int32_t i)
    {
        const FlierSeed& seed = m_scratch.layout.flier_seeds[as_index(i)];
        begin_at_start(m_state, seed.body, m_scratch.solver.states[as_index(seed.state)]);
        Flier& flier = m_scratch.flight.fliers[as_index(i)];
        flier = make_flier(island_ctx, seed.state, seed.body, seed.kind);
        flier.landed = seed.landed;
        m_scratch.flight.event_times[as_index(i)] = 1e300;
        m_scratch.flight.flier_of_state[as_index(seed.state)] = i;
        if (!seed.landed)
            m_scratch.solver.states[as_index(seed.state)].flags |= body_flag::flier;
    }

    // --- joints -----------------------------------------------------------------------------------------------------------------------

    void place_joints()
    {
        m_scratch.layout.joints_outside_lanes.clear();
        m_scratch.layout.joint_lanes.clear();
        m_scratch.solver.joint_bucket_starts.clear();
        m_scratch.layout.bound_by_joint.assign(m_scratch.solver.state_bodies.size(), 0);
        set_size(m_scratch.layout.joint_colors, m_scratch.solver.state_bodies.size());
        m_blocks = 0;
        for (Island& island : m_scratch.solver.islands)
            place_joints_of(island);
    }

    // Where joints are solved directly and nothing touches, axes are also solved for the drift along parabolas.
    void let_drift(Island& island)
    {
        island.all_direct = island.joint_count > 0 && solves_all_joints_directly(island.policy, island.wide_joint_count > 0);
        island.drifts = island.all_direct && island.constraint_count == 0 && island.wide_count == 0;
        if (island.drifts)
            std::fill_n(m_scratch.layout.bound_by_joint.begin() + island.first_state, island.state_count, 0);
    }

    // Marks the color as taken.
    int free_color(const Island& island, std::int32_t a, std::int32_t b)
    {
        std::uint64_t& of_a = m_scratch.layout.joint_colors[as_index(a)];
        std::uint64_t& of_b = m_scratch.layout.joint_colors[as_index(b)];
        const int color = std::countr_one((is_dynamic(island, a) ? of_a : 0) | (is_dynamic(island, b) ? of_b : 0));
        if (color >= color_limit)
            return color_limit;
        of_a |= std::uint64_t{1} << color;
        of_b |= std::uint64_t{1} << color;
        return color;
    }

    // In an island with more joints than are solved directly, hinges are placed in lanes, by color; the other joints are solved one by one.
    void place_joints_of(Island& island)
    {
        const bool wide = island.policy.wide_joints;
        const bool uniform = wide && is_uniform(m_ctx, island);
        island.first_joint = static_cast<std::int32_t>(m_scratch.layout.joints_outside_lanes.size());
        island.first_wide_joint = m_blocks;
        if (wide)
            std::fill_n(m_scratch.layout.joint_colors.begin() + island.first_state, island.state_count, 0);
        const std::size_t first_lane = m_scratch.layout.joint_lanes.size();
        for (std::int32_t i = island.first_joint_edge; i < island.first_joint_edge + island.joint_edge_count; ++i)
        {
            const JointEdge& j = m_scratch.graph.solved_joints[as_index(i)];
            const StatePair states = m_scratch.layout.joint_states[as_index(i)];
            const SolvedJoint joint = {j.joint, states.a, states.b};
            if (!wide || !place_joint_in_lane(island, j, joint, uniform))
                m_scratch.layout.joints_outside_lanes.push_back(joint);
            if (j.binds)
                m_scratch.layout.bound_by_joint[as_index(states.a)] = m_scratch.layout.bound_by_joint[as_index(states.b)] = 1;
        }
        block_joints(island, first_lane);
        island.first_joint_lane = static_cast<std::int32_t>(first_lane);
        island.joint_lane_count = static_cast<std::int32_t>(m_scratch.layout.joint_lanes.size() - first_lane);
        island.joint_count = static_cast<std::int32_t>(m_scratch.layout.joints_outside_lanes.size()) - island.first_joint;
        island.wide_joint_count = m_blocks - island.first_wide_joint;
    }

    // Finds a color for the joint; false where it must be solved outside of lanes.
    bool place_joint_in_lane(const Island& island, const JointEdge& j, const SolvedJoint& joint, bool uniform)
    {
        if (!j.hinge || j.flies || !(uniform || give_evenly(m_ctx, joint)))
            return false;
        const std::int32_t color = free_color(island, joint.a, joint.b);
        if (color == color_limit)
            return false;
        m_scratch.layout.joint_lanes.push_back({2 * color + (j.holds ? 0 : 1), none, joint});
        return true;
    }

    // Stable counting sort.
    void sort_by_bucket(std::size_t first)
    {
        std::vector<JointLane>& lanes = m_scratch.layout.joint_lanes;
        if (lanes.size() == first)
            return;
        std::int32_t starts[2 * color_limit + 1] = {};
        for (std::size_t i = first; i < lanes.size(); ++i)
            ++starts[lanes[i].bucket + 1];
        for (int bucket = 0; bucket < 2 * color_limit; ++bucket)
            starts[bucket + 1] += starts[bucket];
        std::vector<JointLane>& sorted = m_scratch.layout.sorted_lanes;
        set_size(sorted, lanes.size() - first);
        for (std::size_t i = first; i < lanes.size(); ++i)
            sorted[as_index(starts[lanes[i].bucket]++)] = lanes[i];
        std::copy(sorted.begin(), sorted.end(), lanes.begin() + static_cast<std::ptrdiff_t>(first));
    }

    // Sorts the joints by bucket, forms blocks of eight, and assigns lanes.
    void block_joints(Island& island, std::size_t first)
    {
        const auto begin = m_scratch.layout.joint_lanes.begin() + static_cast<std::ptrdiff_t>(first);
        sort_by_bucket(first);
        island.first_joint_bucket = static_cast<std::int32_t>(m_scratch.solver.joint_bucket_starts.size());
        std::int32_t bucket = none;
        int lane = 0;
        std::int32_t next_bucket = 0; // next bucket to begin
        for (auto l = begin; l != m_scratch.layout.joint_lanes.end(); ++l)
        {
            for (; next_bucket <= l->bucket; ++next_bucket)
                m_scratch.solver.joint_bucket_starts.push_back(m_blocks - island.first_wide_joint);
            if (l->bucket != bucket || lane == lane_count)
            {
                ++m_blocks;
                lane = 0;
            }
            bucket = l->bucket;
            l->lane = (m_blocks - 1) * lane_count + lane++;
        }
        for (; next_bucket % 2 != 0; ++next_bucket)
            m_scratch.solver.joint_bucket_starts.push_back(m_blocks - island.first_wide_joint);
        m_scratch.solver.joint_bucket_starts.push_back(m_blocks - island.first_wide_joint);
        island.joint_bucket_count = next_bucket;
    }

    StepContext& m_ctx;
    SceneState& m_state;
    Scratch& m_scratch;
    std::int32_t m_blocks = 0; ///< number of wide joint constraints
};

} // namespace

bool is_uniform(const StepContext& ctx, const Island& island)
{
    for (std::int32_t s = island.first_state; ctx.scratch.graph.has_uneven && s < island.first_state + island.state_count; ++s)
    {
        if (!has_even_mass(ctx, s))
            return false;
    }
    return true;
}

bool has_even_mass(const StepContext& ctx, std::int32_t state)
{
    const int body = ctx.scratch.solver.state_bodies[as_index(state)];
    if (body == none)
        return true;
    const Vec2 inverse_mass = ctx.state.sims[as_index(body)].inverse_mass;
    return inverse_mass.x == inverse_mass.y;
}

void refill_islands(StepContext& ctx)
{
    IslandLayout layout(ctx);
    layout.fill_states();
    layout.bind_as_before();
    layout.add_fliers();
    layout.add_laws();
    layout.count();
    ctx.report.islands = static_cast<int>(ctx.scratch.solver.islands.size());
}

void lay_out_islands(StepContext& ctx)
{
    IslandLayout layout(ctx);
    run_both(ctx.scene.def.tasks, [&] { layout.place_states(); }, [&] { sort_edges(ctx); });
    layout.fill_states_and_place_constraints_and_joints();
    layout.add_fliers();
    layout.add_laws();
    layout.make_room();
    layout.count();
}

} // namespace carom::internal
