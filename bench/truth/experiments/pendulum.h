#pragma once

/// @file
/// The single pendulum's motion, for experiment 6 and its picture.

#include "truth/experiment.h"

namespace truth {

/// Angle from straight down at the start and after each step, radians; the arm is 1 m, the disc 1 kg and 0.1 m.
[[nodiscard]] std::vector<double> pendulum_angles(const Setup& setup, double release, double seconds);

} // namespace truth
