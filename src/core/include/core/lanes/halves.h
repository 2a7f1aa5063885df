#pragma once

// Two registers as one with twice the lanes: every operation is done on both halves. Eight lanes are two registers of four where the machine has
// no wider ones. Sixteen are two vectors of eight in flight: while one waits for its last result, the other is computed.

#include "core/compiler.h"

#include <cstring>

namespace carom::internal::lanes {

template <class R>
struct Halves
{
    R low;
    R high;
};
template <class R>
Halves(R, R) -> Halves<R>;

/// Reads a register from memory, or reinterprets one register as another.
template <class R>
CAROM_INLINE R read(const void* p)
{
    R r;
    std::memcpy(&r, p, sizeof r);
    return r;
}

} // namespace carom::internal::lanes
