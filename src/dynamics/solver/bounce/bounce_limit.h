#pragma once

// Bounces of several contacts at once, with different restitutions and through joints, may ask for more energy than the bodies brought along. They are then
// cut to a share of themselves that leaves the energy as it was: along the direction found, in which neither joints nor surfaces object.

#include "dynamics/solver/contact/contact_solver.h"

#include <span>
#include <vector>

namespace carom::internal {

/// The kinetic energy of the dynamic bodies of an island, J.
[[nodiscard]] double kinetic_energy(const SolverView& view, const Island& island);

/// The present speeds of an island's states, in their order.
void take_speeds(const SolverView& view, const Island& island, std::vector<BodySpeeds>& out);

/// Cuts a bounce to this kinetic energy, J. `stopped` are the speeds that take_speeds found before it.
void limit_bounce(const SolverView& view, const Island& island, std::span<const ContactBounce> bounces,
                  std::span<const BodySpeeds> stopped, double most);

} // namespace carom::internal
