#pragma once

// Two registers as one of twice the lanes: every operation is done to both halves. Eight lanes are two registers of four where the machine has
// no wider ones, and twice eight are two eights in flight: while one waits for its last result, the other is calculated.

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

/// The bytes there as a register, or those of one as another.
template <class R>
CAROM_INLINE R read(const void* p)
{
    R r;
    std::memcpy(&r, p, sizeof r);
    return r;
}

} // namespace carom::internal::lanes
