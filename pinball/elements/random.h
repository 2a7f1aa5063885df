#pragma once

/// @file
/// Random numbers of our own, so that a seed means the same game everywhere.

#include "scenes/random.h"

namespace carom::pinball {

class Random : public SplitMix64
{
public:
    explicit Random(std::uint64_t seed = 1) : SplitMix64(seed) {}
    /// From low up to high; 24 bits, so that a float holds it exactly.
    float between(float low, float high)
    {
        return low + (high - low) * (static_cast<float>(bits() >> 40) * (1.0f / 16777216.0f));
    }
};

} // namespace carom::pinball
