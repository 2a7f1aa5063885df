#pragma once

// A hash over values that are added field by field, so that padding bytes never count.

#include <bit>
#include <cstdint>

namespace carom::internal {

/// The finalizer of splitmix64: mixes every bit into every other.
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x)
{
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9u;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebu;
    x ^= x >> 31;
    return x;
}

class Hasher
{
public:
    constexpr void add(std::uint64_t bits) { m_hash = mix_bits(m_hash ^ (bits + 0x9e3779b97f4a7c15u)); }
    constexpr void add(int value) { add(static_cast<std::uint64_t>(static_cast<std::uint32_t>(value))); }
    // -0 and +0 compare equal but divide differently, so they count as different.
    constexpr void add(float value) { add(static_cast<std::uint64_t>(std::bit_cast<std::uint32_t>(value))); }
    constexpr void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    [[nodiscard]] constexpr std::uint64_t value() const { return m_hash; }

private:
    std::uint64_t m_hash = 0x6361726f6d;
};

} // namespace carom::internal
