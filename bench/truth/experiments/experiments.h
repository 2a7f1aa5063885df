#pragma once

/// @file
/// The experiments, one file each.

#include "truth/experiment.h"

namespace truth {

Metrics elastic_ball(const Setup& setup);
Metrics restitution(const Setup& setup);
Metrics two_discs(const Setup& setup);
Metrics box_corner(const Setup& setup);
Metrics inclines(const Setup& setup);
Metrics pendulums(const Setup& setup);
Metrics springs(const Setup& setup);
Metrics cradle(const Setup& setup);
Metrics billiards(const Setup& setup);
Metrics tunneling(const Setup& setup);
Metrics sensors(const Setup& setup);
Metrics stacks(const Setup& setup);
Metrics chains(const Setup& setup);
Metrics pile(const Setup& setup);
Metrics flipper_shot(const Setup& setup);
Metrics gas(const Setup& setup);
Metrics long_rows(const Setup& setup);
Metrics spectators(const Setup& setup);
Metrics struck_joints(const Setup& setup);
Metrics linkages(const Setup& setup);
Metrics long_chains(const Setup& setup);
Metrics spring_nets(const Setup& setup);
Metrics rocking(const Setup& setup);
Metrics carts(const Setup& setup);

} // namespace truth
