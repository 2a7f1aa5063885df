#pragma once

// Lists of bodies and contacts name records all over memory. A loop that asks for those of a later turn does not wait for them then. They are asked into the
// second cache: the first is too small for what is turns away, and has too few places for lines on their way.

#include "core/compiler.h"

#include <cstddef>

namespace carom::internal {

inline constexpr std::size_t prefetch_distance = 8; ///< of loops over bodies: some hundred ns, what memory takes

/// Asks for a record, all of its cache lines where they begin with it. Inlined in any case: g++ leaves out calls of functions that do nothing else.
template <class Record>
CAROM_INLINE void prefetch(const Record& record)
{
    constexpr std::size_t line = 64;
    for (std::size_t at = 0; at < sizeof(Record); at += line)
        prefetch_line(reinterpret_cast<const char*>(&record) + at);
}

} // namespace carom::internal
