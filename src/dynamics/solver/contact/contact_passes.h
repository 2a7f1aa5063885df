#pragma once

// The passes over all contacts of an island: those that stand in lanes, by color and spatial partition, and those outside of lanes after them.

#include "dynamics/solver/contact/partitions.h"
#include "dynamics/solver/integrate.h"
#include "dynamics/solver/simd/kernels.h"
#include "dynamics/solver/solved_island.h"
#include "dynamics/solver/walls.h"

namespace carom::internal {

class ContactPasses
{
public:
    explicit ContactPasses(SolvedIsland& work);

    /// For sub-step k, before velocities are integrated.
    [[nodiscard]] WarmStart begin_substep(int k);
    /// What the contacts gave in the last sub-step, unless velocities have it already.
    void warm_start();

    /// One pass over what stands in lanes. is_last: of several passes in the sub-step; impulses are summed over the step in it alone.
    void solve_wide(bool use_bias, bool is_last);
    /// One pass over the others.
    void solve_others(bool use_bias);
    /// Once a relaxation is done: some passes more where many bodies overlap far.
    void relax_deep_overlaps();
    /// A relaxation comes again: what the last one added to the sums over the step is taken out.
    void take_from_sums() { take_from_sums(0, m_work.island.wide_count); }

    /// All of an island that stands in lanes alone: each partition goes from solving through its new poses to relaxing at once, while its constraints are in the cache. What
    /// crosses from one to another is solved before and relaxed after.
    void solve_by_partition();
    /// After that: partitions in which something in flight has struck, and contacts that have come since, relax once more.
    void relax_struck();

    [[nodiscard]] Walls walls() const;
    /// Its bodies note what they would do without constraints.
    [[nodiscard]] bool notes_bodies() const { return m_notes_bodies; }

private:
    [[nodiscard]] WideBucket lanes(int first, int last) const;
    void solve_lanes(int first, int last) const;
    void relax_lanes(int first, int last);
    void relax_again(int first, int last);
    void take_from_sums(int first, int last) const;
    [[nodiscard]] float deep() const;

    SolvedIsland& m_work;
    WideContact* m_wide;
    WideContactNotes* m_notes;
    std::uint8_t* m_struck; ///< lanes of each block
    WideSoftness m_softness;
    Partitions m_partitions;
    const WideKernels& m_kernels = wide_kernels();
    bool m_notes_bodies;
    bool m_starts_by_body = false; ///< in this sub-step
    int m_is_deep = 0;             ///< some overlap of lanes is pushed out as fast as allowed
};

} // namespace carom::internal
