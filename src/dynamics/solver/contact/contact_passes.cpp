// Runs the kernels over an island's wide contact constraints, in the order of colors and partitions.

#include "dynamics/solver/contact/contact_passes.h"

#include "core/index.h"
#include "dynamics/state/scene_data.h"

#include <algorithm>
#include <atomic>
#include <span>
#include <utility>

namespace carom::internal {

namespace {

constexpr int passes_of_deep_overlaps = 10; // for each that has pushed

} // namespace

ContactPasses::ContactPasses(SolvedIsland& work)
    : m_work(work), m_wide(work.scratch.solver.wide_contacts.data() + work.island.wide_store),
      m_notes(work.scratch.solver.wide_notes.data() + work.island.wide_store),
      m_features(work.scratch.solver.wide_features.data() + work.island.wide_store),
      m_blows(blow_bits(work.scratch, work.island)),
      m_softness{
          work.ctx.h,          work.view.inverse_h, work.view.push_speed, work.ctx.contact_softness, work.ctx.static_softness,
          least_blow(work.ctx)},
      m_partitions(contact_buckets(work.scratch, work.island)),
      m_notes_bodies(work.island.wide_count > 0 && work.island.joint_count == 0 && work.island.wide_joint_count == 0)
{}

// Where points and normals do not change within the step, a body may be given at once the impulses of all its constraints.
WarmStart ContactPasses::begin_substep(int k)
{
    const bool disturbed = std::exchange(m_work.output.disturbed, false);
    m_starts_by_body = m_notes_bodies && k > 0 && !disturbed;
    return m_starts_by_body ? WarmStart::ByBody : m_notes_bodies ? WarmStart::NotesBodies : WarmStart::ByConstraint;
}

void ContactPasses::warm_start()
{
    if (m_starts_by_body)
        return;
    m_partitions.by_color(m_work.team,
                          [&](int first, int last) { m_kernels.warm_start(lanes(first, last), m_work.view.states); });
    internal::warm_start(m_work.view, m_work.constraints);
    internal::warm_start(m_work.view, m_work.late_constraints());
}

void ContactPasses::solve_wide(bool use_bias, bool again)
{
    if (again && !use_bias)
        take_from_sums();
    m_partitions.by_color(m_work.team,
                          [&](int first, int last) { use_bias ? solve_lanes(first, last) : relax_lanes(first, last); });
}

void ContactPasses::solve_others(bool use_bias)
{
    solve_contact_constraints(m_work.view, m_work.constraints, use_bias);
    solve_contact_constraints(m_work.view, m_work.late_constraints(), use_bias);
}

void ContactPasses::solve_by_partition()
{
    const Island& island = m_work.island;
    const auto solve = [this](int first, int last) { solve_lanes(first, last); };
    const auto relax = [this](int first, int last) { relax_lanes(first, last); };
    integrate_positions(m_work, island.first_state + 1 + island.dynamic_count,
                        island.first_state + island.state_count); // kinematic bodies
    const auto partitions =
        std::span(m_work.scratch.solver.partition_of).subspan(as_index(island.first_state + 1), as_index(island.dynamic_count));
    const Walls walls = this->walls();
    m_partitions.boundary(m_work.team, solve);
    m_partitions.in_parts(m_work.team,
                          [&](int partition)
                          {
                              const auto states = std::ranges::equal_range(partitions, static_cast<std::uint16_t>(partition));
                              const auto first = static_cast<int>(states.begin() - partitions.begin()) + island.first_state + 1;
                              m_partitions.of_part(partition, solve);
                              integrate_positions(m_work, first, first + static_cast<int>(states.size()));
                              m_partitions.of_part(partition, [&](int begin, int end) { walls.guard_wide_cores(begin, end); });
                              m_partitions.of_part(partition, relax);
                          });
    m_partitions.boundary(m_work.team, relax);
}

void ContactPasses::relax_struck()
{
    std::vector<std::int32_t>& partitions = m_work.output.struck_states;
    if (partitions.empty() && m_work.late_constraints().empty())
        return;
    std::ranges::transform(partitions, partitions.begin(),
                           [&](std::int32_t state) { return m_work.scratch.solver.partition_of[as_index(state)]; });
    std::erase_if(partitions,
                  [&](std::int32_t partition) { return partition >= m_work.island.partitions; }); // for bodies of infinite mass
    std::ranges::sort(partitions);
    partitions.erase(std::ranges::unique(partitions).begin(), partitions.end());
    const auto relax = [this](int first, int last) { relax_again(first, last); };
    m_partitions.boundary(m_work.team, relax);
    m_work.team.in_pieces(static_cast<int>(partitions.size()), false,
                          [&](int i) { m_partitions.of_part(partitions[as_index(i)], relax); });
    solve_contact_constraints(m_work.view, m_work.late_constraints(), false);
}

void ContactPasses::relax_again(int first, int last)
{
    take_from_sums(first, last);
    relax_lanes(first, last);
}

void ContactPasses::take_from_sums(int first, int last) const
{
    for (int g = first; g < last; ++g)
    {
        for (WidePoint& p : std::span(m_wide[g].points).first(as_index(m_notes[g].count)))
        {
            for (int i = 0; i < lane_count; ++i)
            {
                p.total_impulse.v[i] -= p.normal_impulse.v[i];
                p.total_tangent.v[i] -= p.tangent_impulse.v[i];
            }
        }
    }
}

// Blocks of one bucket.
WideBucket ContactPasses::lanes(int first, int last) const
{
    return {m_wide + first, m_notes + first, m_features + first, last - first, are_constraints_far(m_work.island)};
}

void ContactPasses::solve_lanes(int first, int last) const
{
    m_kernels.solve(lanes(first, last), m_work.view.states, m_softness);
}

void ContactPasses::relax_lanes(int first, int last)
{
    const float least = m_kernels.relax(lanes(first, last), m_work.view.states, m_softness, m_work.scratch.solver.speeds.data(),
                                        {m_blows.struck + first, m_blows.relieved + first});
    if (least < deep())
        std::atomic_ref(m_is_deep).store(1, std::memory_order_relaxed);
}

// The speeds at which many bodies are pushed out of each other add up, and one pass takes out little of them: the
// bodies would fly apart. Islands with partitions do without, because it would cost too much there.
void ContactPasses::relax_deep_overlaps()
{
    if (std::exchange(m_is_deep, 0) == 0 || m_work.island.partitions > 0)
        return;
    for (int i = 0; i < passes_of_deep_overlaps * m_work.island.policy.passes; ++i)
    {
        m_partitions.by_color(m_work.team, [this](int first, int last) { relax_again(first, last); });
        solve_others(false);
    }
    m_is_deep = 0;
}

// Beyond this separation, overlap is pushed out as fast as allowed. No load presses bodies so far into each other.
float ContactPasses::deep() const { return -m_work.view.push_speed / m_softness.contact.bias_rate; }

Walls ContactPasses::walls() const
{
    const Island& island = m_work.island;
    const auto cores = std::span(m_work.scratch.solver.cores).subspan(as_index(island.first_core), as_index(island.core_count));
    return {m_work.view,
            {m_work.constraints,
             m_work.late_constraints(),
             m_work.output.pulled_constraints,
             {m_wide, as_index(island.wide_count)},
             cores}};
}

} // namespace carom::internal
