#pragma once

// Wide contact constraints whose lanes still hold the contacts of the last step: poses and cached manifolds refresh them, eight at a time.

#include "dynamics/solver/simd/kernels.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Lanes of a wide constraint, as bits.
struct RefreshChanges
{
    std::uint32_t gone = 0; ///< their contacts no longer fit the lanes
    std::uint32_t told = 0; ///< their contacts begin or end to touch, or may hit a sleeper
};

/// Refreshes a task's wide constraints, one after the other.
class ConstraintRefresh
{
public:
    explicit ConstraintRefresh(const StepContext& ctx);

    /// The wide constraint at an index in SolverWorkspace::wide_contacts. Lanes that cannot be followed, or whose touch may begin or end, are updated one by one and refilled. Lanes that are gone are left in an arbitrary state.
    /// All contacts must have their lane marks.
    [[nodiscard]] RefreshChanges follow(std::size_t at);

private:
    void look_at(std::size_t at, int lane, RefreshChanges& changes);
    void note_borne(const WideContact& constraint, int i) const;
    void note_if_loaded(const WideContact& constraint, const WideContactNotes& notes, int i, float separation) const;

    const StepContext& m_ctx;
    SceneState& m_state;
    Scratch& m_scratch;
    FollowedScene m_scene;
    const WideKernels& m_kernels = wide_kernels();
};

} // namespace carom::internal
