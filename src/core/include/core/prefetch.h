#pragma once

// Lists of bodies and contacts name records all over memory. A loop that prefetches the records of a later iteration does not wait for them then. They go into
// the second-level cache: the first is too small for data that is iterations away, and has too few buffers for lines in flight.

#include "core/compiler.h"

#include <cstddef>

namespace carom::internal {

inline constexpr std::size_t prefetch_distance = 8; ///< for loops over bodies: some hundred ns, the latency of memory

/// Prefetches all cache lines of a record that begins with one. Always inlined: g++ drops calls of functions that do nothing else.
template <class Record>
CAROM_INLINE void prefetch(const Record& record)
{
    constexpr std::size_t line = 64;
    for (std::size_t at = 0; at < sizeof(Record); at += line)
        prefetch_line(reinterpret_cast<const char*>(&record) + at);
}

} // namespace carom::internal
