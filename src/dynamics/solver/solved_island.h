#pragma once

// An island while it is solved: the data that the parts of its solver share.

#include "core/worker_team.h"
#include "dynamics/narrowphase/contact_update.h"
#include "dynamics/solver/contact/contact_solver.h"
#include "dynamics/step_context.h"

#include <algorithm>
#include <cstdint>
#include <span>

namespace carom::internal {

struct SolvedIsland
{
    SolvedIsland(const StepContext& step, const Island& island, IslandOutput& output, WorkerTeam& team);

    StepContext ctx; ///< with the island's subdivision of sub-steps
    Scratch& scratch;
    const Island& island;
    IslandOutput& output;
    WorkerTeam& team;
    SolverView view;
    std::span<ContactConstraint> constraints; ///< outside of lanes
    std::span<JointWork> joints;              ///< likewise

    /// Constraints that have come since the step began.
    [[nodiscard]] std::span<ContactConstraint> late_constraints() const { return output.late_constraints; }

    template <class Visit>
    void for_each_constraint(const Visit& visit) const
    {
        for (const std::span<ContactConstraint> some : {constraints, late_constraints()})
            std::for_each(some.begin(), some.end(), visit);
    }

    [[nodiscard]] bool has_contacts() const
    {
        return !constraints.empty() || !late_constraints().empty() || island.wide_count > 0;
    }
    [[nodiscard]] bool has_fliers() const; ///< whether any of its bodies is in flight now
    [[nodiscard]] bool is_dynamic(std::int32_t state) const { return (view.states[state].flags & body_flag::dynamic) != 0; }

    /// The pose of a body within the step, moved on by its present speeds over a time `ahead`, s.
    [[nodiscard]] BodyPose pose_of(int body, std::int32_t state, float ahead) const;
};

/// True for a contact that gets no constraint.
[[nodiscard]] inline bool is_left_out(const Contact& contact)
{
    return (contact.flags & (contact_flag::trigger | contact_flag::passing)) != 0;
}

} // namespace carom::internal
