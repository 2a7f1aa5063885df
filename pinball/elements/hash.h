#pragma once

/// @file
/// A hash over values, for comparing games: FNV-1a on their bits, the same on every platform.

#include "carom/math.h"

#include <bit>
#include <cstdint>

namespace carom::pinball {

class Hash
{
public:
    void add(std::uint64_t bits)
    {
        for (int i = 0; i < 8; ++i, bits >>= 8)
            m_value = (m_value ^ (bits & 0xff)) * 0x100000001b3;
    }
    void add(std::int64_t value) { add(static_cast<std::uint64_t>(value)); }
    void add(std::uint32_t value) { add(std::uint64_t{value}); }
    void add(int value) { add(std::int64_t{value}); }
    void add(bool value) { add(std::uint64_t{value ? 1u : 0u}); }
    void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value)}); }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(Vec2 v)
    {
        add(v.x);
        add(v.y);
    }
    [[nodiscard]] std::uint64_t value() const { return m_value; }

private:
    std::uint64_t m_value = 0xcbf29ce484222325;
};

} // namespace carom::pinball
