#pragma once

// How much one task gets: some ten microseconds of work, so that handing it out costs little and the last thread is waited for a short time.

#include <cstddef>

namespace carom::internal {

inline constexpr std::size_t bodies_per_task = 512;
inline constexpr std::size_t fliers_per_task = 128;
inline constexpr std::size_t contacts_per_task = 1024;
inline constexpr std::size_t joints_per_task = 1024;
inline constexpr std::size_t edges_per_task = 2048; ///< they are small and stand in order

} // namespace carom::internal
