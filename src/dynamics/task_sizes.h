#pragma once

// Sizes of tasks: some ten microseconds of work each, so that handing one out costs little and the wait for the last worker is short.

#include <cstddef>

namespace carom::internal {

inline constexpr std::size_t bodies_per_task = 512;
inline constexpr std::size_t fliers_per_task = 128;
inline constexpr std::size_t contacts_per_task = 1024;
inline constexpr std::size_t joints_per_task = 1024;
inline constexpr std::size_t edges_per_task = 2048; ///< edges are small and contiguous

} // namespace carom::internal
