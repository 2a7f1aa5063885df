#pragma once

// Wide constraints whose lanes hold contacts of the last step still: poses and cached manifolds say what has become of them, eight at a time.

#include "dynamics/solver/simd/kernels.h"
#include "dynamics/step_context.h"

namespace carom::internal {

/// Lanes of a constraint, as bits.
struct RefreshChanges
{
    std::uint32_t gone = 0; ///< their contacts are not what the lanes were made for
    std::uint32_t told = 0; ///< their contacts begin to touch or end, or may hit a sleeper
};

/// One of a task's constraints after the other.
class ConstraintRefresh
{
public:
    explicit ConstraintRefresh(const StepContext& ctx);

    /// Lanes that cannot be followed, or whose touch may begin or end, are updated by themselves and filled again. Those that are gone are left as they come.
    /// All contacts must have their lane marks.
    [[nodiscard]] RefreshChanges follow(WideContact& constraint, WideContactNotes& notes);

private:
    void look_at(WideContact& constraint, WideContactNotes& notes, int i, RefreshChanges& changes);
    void note_borne(const WideContact& constraint, int i) const;
    void note_if_loaded(const WideContact& constraint, const WideContactNotes& notes, int i, float separation) const;

    const StepContext& m_ctx;
    SceneState& m_state;
    Scratch& m_scratch;
    FollowedScene m_scene;
    const WideKernels& m_kernels = wide_kernels();
};

} // namespace carom::internal
