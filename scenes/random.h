#pragma once

/// @file
/// SplitMix64 (Steele, Lea, Flood 2014): the same random numbers from a seed on every machine and with every compiler.

#include <cstdint>

namespace carom {

class SplitMix64
{
public:
    explicit SplitMix64(std::uint64_t seed) : m_state(seed) {}

    std::uint64_t bits()
    {
        std::uint64_t z = m_state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31u);
    }
    /// From 0 (included) to 1 (excluded).
    double unit() { return static_cast<double>(bits() >> 11u) * 0x1p-53; }
    /// From 0 to count - 1.
    int below(int count) { return static_cast<int>(bits() % static_cast<std::uint64_t>(count)); }
    [[nodiscard]] std::uint64_t state() const { return m_state; }

private:
    std::uint64_t m_state;
};

} // namespace carom
