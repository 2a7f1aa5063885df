#pragma once

/// @file
/// The flipper shot, for experiment 15 and its picture.

#include "truth/experiment.h"

namespace truth {

struct Shot
{
    Vec velocity{}; ///< of the ball after 0.12 s, gravity's share taken off
    [[nodiscard]] double speed() const { return length(velocity); }
    [[nodiscard]] double angle() const { return std::atan2(velocity.y, velocity.x); }
};

/// The bar reaches the ball at phase · dt.
[[nodiscard]] Shot flipper_shot_of(const Setup& setup, double restitution, double phase);
/// The same by a reference integration in steps of a microsecond.
[[nodiscard]] Shot exact_flipper_shot(double dt, double restitution, double phase);

} // namespace truth
