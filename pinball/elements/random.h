#pragma once

/// @file
/// Random numbers of our own, so that a seed means the same game everywhere: SplitMix64 (Steele, Lea, Flood 2014).

#include <cstdint>

namespace carom::pinball {

class Random
{
public:
    explicit Random(std::uint64_t seed = 1) : m_state(seed) {}

    std::uint64_t next()
    {
        std::uint64_t z = (m_state += 0x9e3779b97f4a7c15);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }
    /// From low up to high; 24 bits, so that a float holds it exactly.
    float between(float low, float high)
    {
        return low + (high - low) * (static_cast<float>(next() >> 40) * (1.0f / 16777216.0f));
    }
    /// From 0 to count - 1.
    int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
    [[nodiscard]] std::uint64_t state() const { return m_state; }

private:
    std::uint64_t m_state;
};

} // namespace carom::pinball
