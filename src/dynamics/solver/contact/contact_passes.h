#pragma once

// The passes over all contacts of an island: wide contact constraints by color and partition, and after them the constraints outside of lanes.

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

    /// Called for sub-step k before velocities are integrated.
    [[nodiscard]] WarmStart begin_substep(int k);
    /// Applies the impulses of the last sub-step, unless velocities have them already.
    void warm_start();

    /// One pass over the wide contact constraints, the first one or another one. Without bias it adds impulses to the sums over the step, for those of the
    /// last pass.
    void solve_wide(bool use_bias, bool again);
    /// One pass over the constraints outside of lanes.
    void solve_others(bool use_bias);
    /// Called after a relaxation: runs more passes where many bodies overlap far.
    void relax_deep_overlaps();
    /// Called before a relaxation is repeated: takes what the last one added out of the sums over the step.
    void take_from_sums() { take_from_sums(0, m_work.island.wide_count); }

    /// Solves an island whose constraints are all in lanes. Each partition goes from solving through its new poses to relaxing at
    /// once, while its constraints are in the cache. Boundary constraints are solved before and relaxed after all partitions.
    void solve_by_partition();
    /// Called after that: relaxes once more the partitions in which fliers have struck, and contacts that have come since.
    void relax_struck();

    [[nodiscard]] Walls walls() const;
    /// True if its bodies note the speeds that they would have without constraints.
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
    WideFeatures* m_features;
    BlowBits m_blows;
    WideSoftness m_softness;
    Partitions m_partitions;
    const WideKernels& m_kernels = wide_kernels();
    bool m_notes_bodies;
    bool m_starts_by_body = false; ///< in this sub-step
    int m_is_deep = 0;             ///< some overlap in lanes is so deep that it is pushed out as fast as allowed
};

} // namespace carom::internal
