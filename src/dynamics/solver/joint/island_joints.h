#pragma once

// The joints of an island over a step: wide joints, which are hinges in blocks of eight lanes, and the others, which are solved directly where they are few.

#include "dynamics/solver/contact/partitions.h"
#include "dynamics/solver/joint/direct/direct_solver.h"
#include "dynamics/solver/simd/kernels.h"
#include "dynamics/solver/solved_island.h"

namespace carom::internal {

class IslandJoints
{
public:
    explicit IslandJoints(SolvedIsland& work);

    /// Once per step: finds where the joints are, what was changed outside the solver since the last step, and at which contacts the joints pull.
    void begin_step();
    /// Updates the joints to the present poses of the bodies. prepare_direct also works at the present poses.
    void place();
    void prepare_direct(DirectSolve::Masses masses);

    /// Records the speeds toward limits, before the forces of a sub-step.
    void note_limit_approach();
    void kick_springs_before();
    void kick_springs_after();
    void warm_start();
    /// One pass. is_last: as in ContactPasses::solve_wide.
    void solve(bool use_bias, bool is_last);
    void bounce_off_limits(bool contacts_have_bounced);
    void finish_substep();
    /// Closes gaps where a body turns so fast within the sub-step that no straight path ends at the right pose.
    void close_gaps();

    /// Whether the joints outside the wide blocks are solved all at once.
    [[nodiscard]] bool are_direct() const { return !m_work.joints.empty() && direct().is_ready(); }
    [[nodiscard]] DirectSolve& direct() const { return *m_work.output.direct; }

private:
    void take_forbidden_speeds();
    void find_pulled_constraints();
    void add_pulled_constraint(int index, int body, std::int32_t own);
    void note_moved();
    void go_on_yielding();
    void forget_pull();

    SolvedIsland& m_work;
    WideJoint* m_wide;
    JointSoftness m_softness;
    Partitions m_buckets;
    const WideKernels& m_kernels = wide_kernels();
};

} // namespace carom::internal
