#pragma once

/// @file
/// The same cases on every machine.

#include "scenes/random.h"

#include <cmath>

namespace truth {

class Random : public carom::SplitMix64
{
public:
    using SplitMix64::SplitMix64;
    /// From low (included) to high (excluded).
    double in(double low, double high) { return low + (high - low) * unit(); }
    /// As above, with equal chances for equal ratios.
    double log_in(double low, double high) { return low * std::pow(high / low, in(0, 1)); }
};

} // namespace truth
