#pragma once

// Four floats that are calculated with at once, on GCC's and Clang's vector extensions: every machine that we build for has registers of that size.
// What needs eight, and a kernel per instruction set, is in lane_math.h.

#include <cstdint>
#include <cstring>

#define CAROM_INLINE inline __attribute__((always_inline))

namespace carom::internal {

using F4 = float __attribute__((vector_size(16)));
using I4 = std::int32_t __attribute__((vector_size(16)));
using D2 = double __attribute__((vector_size(16)));

CAROM_INLINE F4 load4(const float* p)
{
    F4 v;
    std::memcpy(&v, p, sizeof v);
    return v;
}

CAROM_INLINE D2 load2(const double* p)
{
    D2 v;
    std::memcpy(&v, p, sizeof v);
    return v;
}

CAROM_INLINE void store4(float* p, F4 v) { std::memcpy(p, &v, sizeof v); }

CAROM_INLINE F4 least(F4 a, F4 b) { return a < b ? a : b; }
CAROM_INLINE D2 least(D2 a, D2 b) { return a < b ? a : b; }
CAROM_INLINE F4 greatest(F4 a, F4 b) { return a > b ? a : b; }
CAROM_INLINE F4 magnitude(F4 a) { return greatest(a, -a); }
CAROM_INLINE F4 swap_halves(F4 a) { return __builtin_shufflevector(a, a, 2, 3, 0, 1); }

/// A bit for each lane of a comparison that holds.
CAROM_INLINE unsigned bits(I4 mask)
{
#if defined(__SSE__)
    F4 signs;
    std::memcpy(&signs, &mask, sizeof signs);
    return static_cast<unsigned>(__builtin_ia32_movmskps(signs));
#else
    return (mask[0] & 1u) | (mask[1] & 2u) | (mask[2] & 4u) | (mask[3] & 8u);
#endif
}

} // namespace carom::internal
