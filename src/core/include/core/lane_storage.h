#pragma once

// Storage of eight floats side by side, which lane_math.h loads at once.

#include <cstdint>

namespace carom::internal {

inline constexpr int lane_count = 8;

/// Aligned for the widest load.
struct alignas(32) LaneFloats
{
    float v[lane_count];
};
struct alignas(32) LaneInts
{
    std::int32_t v[lane_count];
};

} // namespace carom::internal
