#pragma once

// The backends: each provides types for registers and the operations on them, all in this namespace. A comparison sets all bits of the lanes in which it
// holds. Each lane does the same operation with the rounding of IEEE 754, so that every backend gives the same bits:
//
//   four_sse2.h     x86-64, any compiler               FourFloats, FourInts, TwoDoubles
//   four_vector.h   NEON, WebAssembly's SIMD           "
//   four_scalar.h   plain C++ (CAROM_SCALAR_LANES)     "
//   eight_avx2.h    AVX2 and AVX-512                   EightFloats, EightInts, EightDoubles
//   eight_halves.h  two registers of four              "
//
// Nothing else uses a register; vectors.h wraps them in types with operators.

#include "core/compiler.h"
#include "core/lanes/halves.h"

#if defined(CAROM_SCALAR_LANES)
#include "core/lanes/four_scalar.h"
#elif CAROM_X86
#include "core/lanes/four_sse2.h"
#elif CAROM_GNU && (!defined(__arm__) || defined(__aarch64__)) // 32-bit NEON flushes small numbers to zero
#include "core/lanes/four_vector.h"
#else
#include "core/lanes/four_scalar.h"
#endif

#if defined(__AVX2__) && CAROM_HAS_AVX_KERNELS
#include "core/lanes/eight_avx2.h"
#else
#include "core/lanes/eight_halves.h"
#endif

namespace carom::internal::lanes {

#define CAROM_OF_HALVES(operation)                                                                                               \
    template <class R>                                                                                                           \
    CAROM_INLINE auto operation(Halves<R> a)                                                                                     \
    {                                                                                                                            \
        return Halves{operation(a.low), operation(a.high)};                                                                      \
    }
#define CAROM_OF_TWO_HALVES(operation)                                                                                           \
    template <class R>                                                                                                           \
    CAROM_INLINE auto operation(Halves<R> a, Halves<R> b)                                                                        \
    {                                                                                                                            \
        return Halves{operation(a.low, b.low), operation(a.high, b.high)};                                                       \
    }
CAROM_OF_HALVES(negated)
CAROM_OF_HALVES(root)
CAROM_OF_HALVES(inverted)
CAROM_OF_HALVES(same_bits)
CAROM_OF_HALVES(to_doubles)
CAROM_OF_HALVES(to_floats)
CAROM_OF_TWO_HALVES(add)
CAROM_OF_TWO_HALVES(subtract)
CAROM_OF_TWO_HALVES(multiply)
CAROM_OF_TWO_HALVES(divide)
CAROM_OF_TWO_HALVES(least)
CAROM_OF_TWO_HALVES(greatest)
CAROM_OF_TWO_HALVES(are_less)
CAROM_OF_TWO_HALVES(are_at_most)
CAROM_OF_TWO_HALVES(are_equal)
CAROM_OF_TWO_HALVES(differ)
CAROM_OF_TWO_HALVES(both)
CAROM_OF_TWO_HALVES(either)
#undef CAROM_OF_HALVES
#undef CAROM_OF_TWO_HALVES

template <class Number, class R>
CAROM_INLINE void spread(Number x, Halves<R>& r)
{
    spread(x, r.low);
    spread(x, r.high);
}

template <class M, class R>
CAROM_INLINE Halves<R> choose(Halves<M> mask, Halves<R> a, Halves<R> b)
{
    return {choose(mask.low, a.low, b.low), choose(mask.high, a.high, b.high)};
}

/// One bit per lane, set where the lane's sign bit is: where a comparison holds.
CAROM_INLINE unsigned signs(Halves<FourInts> a) { return signs(a.low) | signs(a.high) << 4; }

} // namespace carom::internal::lanes
