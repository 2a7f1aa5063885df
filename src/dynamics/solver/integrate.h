#pragma once

// Integrates velocities and positions of an island's bodies over a sub-step, on all threads of its worker team.

#include "dynamics/solver/solved_island.h"

namespace carom::internal {

/// How warm starting applies the impulses of the last sub-step again.
enum class WarmStart : std::uint8_t
{
    ByConstraint,
    NotesBodies, ///< and notes the speeds that ByBody needs in the next sub-step
    ByBody ///< at once, as velocities are integrated: the change that constraints made to the body's speeds in the last sub-step
};

/// v += h a, then damping. Fliers are moved by flight instead.
void integrate_velocities(const SolvedIsland& work, WarmStart start);

/// x += h v
void integrate_positions(const SolvedIsland& work);
/// The same for states first to last, on this thread.
void integrate_positions(const SolvedIsland& work, int first, int last);

} // namespace carom::internal
