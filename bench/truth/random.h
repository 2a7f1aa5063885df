#pragma once

/// @file
/// splitmix64: the same cases on every machine.

#include <cmath>
#include <cstdint>

namespace truth {

class Random
{
public:
    explicit Random(std::uint64_t seed) : m_state(seed) {}
    std::uint64_t bits()
    {
        std::uint64_t z = m_state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30u)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27u)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31u);
    }
    /// From low (included) to high (excluded).
    double in(double low, double high) { return low + (high - low) * (static_cast<double>(bits() >> 11u) * 0x1p-53); }
    /// As above, with equal chances for equal ratios.
    double log_in(double low, double high) { return low * std::pow(high / low, in(0, 1)); }

private:
    std::uint64_t m_state;
};

} // namespace truth
