#pragma once

// Velocities and positions of an island's bodies over a sub-step, on all threads of its team.

#include "dynamics/solver/solved_island.h"

namespace carom::internal {

/// How contacts give again what they gave a body in the last sub-step.
enum class WarmStart : std::uint8_t
{
    ByConstraint,
    NotesBodies, ///< and notes what makes ByBody possible in the next sub-step
    ByBody ///< at once, while velocities are integrated: what its speeds were beyond those that it would have had without constraints
};

/// v += h a, then damping. Bodies in flight have their own path.
void integrate_velocities(const SolvedIsland& work, WarmStart start);

/// x += h v
void integrate_positions(const SolvedIsland& work);
/// The same of states first to last, on this thread.
void integrate_positions(const SolvedIsland& work, int first, int last);

} // namespace carom::internal
