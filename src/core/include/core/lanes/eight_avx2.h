#pragma once

// Registers of eight lanes: AVX2, and AVX-512, which has more of them and separate mask registers. Written with the vector extensions of GCC and Clang, which
// choose how a mask is kept. See registers.h.

#include "core/lanes/four_sse2.h"

#include <cstdint>
#include <cstring>
#include <immintrin.h>

namespace carom::internal::lanes {

using EightFloats = float __attribute__((vector_size(32)));
using EightInts = std::int32_t __attribute__((vector_size(32)));
using FourDoubles = double __attribute__((vector_size(32)));
using FourLongs = std::int64_t __attribute__((vector_size(32)));
using EightDoubles = Halves<FourDoubles>;

CAROM_INLINE EightFloats eight(float a, float b, float c, float d, float e, float f, float g, float h)
{
    return EightFloats{a, b, c, d, e, f, g, h};
}
CAROM_INLINE EightInts eight(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d, std::int32_t e, std::int32_t f,
                             std::int32_t g, std::int32_t h)
{
    return EightInts{a, b, c, d, e, f, g, h};
}
CAROM_INLINE EightDoubles eight(double a, double b, double c, double d, double e, double f, double g, double h)
{
    return {FourDoubles{a, b, c, d}, FourDoubles{e, f, g, h}};
}
CAROM_INLINE EightFloats eight(FourFloats a, FourFloats b) { return __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7); }
CAROM_INLINE void spread(float x, EightFloats& r) { r = EightFloats{x, x, x, x, x, x, x, x}; }
CAROM_INLINE void spread(double x, FourDoubles& r) { r = FourDoubles{x, x, x, x}; }

CAROM_INLINE EightFloats load_aligned_eight(const float* p) { return _mm256_load_ps(p); }
CAROM_INLINE EightInts load_aligned_eight(const std::int32_t* p) { return read<EightInts>(p); }
CAROM_INLINE void store_aligned(float* p, EightFloats v) { _mm256_store_ps(p, v); }
CAROM_INLINE void store_aligned(std::int32_t* p, EightInts v) { std::memcpy(p, &v, sizeof v); }

CAROM_INLINE EightFloats add(EightFloats a, EightFloats b) { return a + b; }
CAROM_INLINE EightFloats subtract(EightFloats a, EightFloats b) { return a - b; }
CAROM_INLINE EightFloats multiply(EightFloats a, EightFloats b) { return a * b; }
CAROM_INLINE EightFloats divide(EightFloats a, EightFloats b) { return a / b; }
CAROM_INLINE EightFloats negated(EightFloats a) { return -a; }
CAROM_INLINE EightFloats root(EightFloats a) { return _mm256_sqrt_ps(a); }
CAROM_INLINE EightFloats least(EightFloats a, EightFloats b) { return _mm256_min_ps(a, b); }
CAROM_INLINE EightFloats greatest(EightFloats a, EightFloats b) { return _mm256_max_ps(a, b); }

CAROM_INLINE FourDoubles add(FourDoubles a, FourDoubles b) { return a + b; }
CAROM_INLINE FourDoubles subtract(FourDoubles a, FourDoubles b) { return a - b; }
CAROM_INLINE FourDoubles multiply(FourDoubles a, FourDoubles b) { return a * b; }
CAROM_INLINE FourDoubles divide(FourDoubles a, FourDoubles b) { return a / b; }
CAROM_INLINE FourDoubles negated(FourDoubles a) { return -a; }
CAROM_INLINE FourDoubles root(FourDoubles a) { return _mm256_sqrt_pd(a); }

CAROM_INLINE EightInts are_less(EightFloats a, EightFloats b) { return a < b; }
CAROM_INLINE EightInts are_at_most(EightFloats a, EightFloats b) { return a <= b; }
CAROM_INLINE EightInts are_equal(EightFloats a, EightFloats b) { return a == b; }
CAROM_INLINE EightInts differ(EightFloats a, EightFloats b) { return a != b; }
CAROM_INLINE EightInts are_less(EightInts a, EightInts b) { return a < b; }
CAROM_INLINE EightInts are_equal(EightInts a, EightInts b) { return a == b; }
CAROM_INLINE FourLongs are_less(FourDoubles a, FourDoubles b) { return a < b; }
CAROM_INLINE FourLongs are_at_most(FourDoubles a, FourDoubles b) { return a <= b; }
CAROM_INLINE FourLongs are_equal(FourDoubles a, FourDoubles b) { return a == b; }

CAROM_INLINE EightInts both(EightInts a, EightInts b) { return a & b; }
CAROM_INLINE EightInts either(EightInts a, EightInts b) { return a | b; }
CAROM_INLINE EightInts inverted(EightInts a) { return ~a; }
CAROM_INLINE EightFloats choose(EightInts mask, EightFloats a, EightFloats b) { return mask ? a : b; }
CAROM_INLINE FourDoubles choose(FourLongs mask, FourDoubles a, FourDoubles b) { return mask ? a : b; }
CAROM_INLINE unsigned signs(EightInts a) { return static_cast<unsigned>(_mm256_movemask_ps(read<EightFloats>(&a))); }
CAROM_INLINE EightInts same_bits(EightFloats a) { return read<EightInts>(&a); }

CAROM_INLINE EightDoubles to_doubles(EightFloats a)
{
    return {_mm256_cvtps_pd(_mm256_castps256_ps128(a)), _mm256_cvtps_pd(_mm256_extractf128_ps(a, 1))};
}
CAROM_INLINE EightFloats to_floats(EightDoubles a) { return eight(_mm256_cvtpd_ps(a.low), _mm256_cvtpd_ps(a.high)); }

CAROM_INLINE EightFloats even_lanes(FourFloats a, FourFloats b, FourFloats c, FourFloats d)
{
    return _mm256_shuffle_ps(eight(a, c), eight(b, d), _MM_SHUFFLE(2, 0, 2, 0));
}
CAROM_INLINE EightFloats odd_lanes(FourFloats a, FourFloats b, FourFloats c, FourFloats d)
{
    return _mm256_shuffle_ps(eight(a, c), eight(b, d), _MM_SHUFFLE(3, 1, 3, 1));
}

/// Eight records of four floats, at(0) to at(7), become four columns.
template <class At>
CAROM_INLINE void gather(const At& at, EightFloats& x, EightFloats& y, EightFloats& z, EightFloats& w)
{
    const EightFloats r0 = eight(load_four(at(0)), load_four(at(4)));
    const EightFloats r1 = eight(load_four(at(1)), load_four(at(5)));
    const EightFloats r2 = eight(load_four(at(2)), load_four(at(6)));
    const EightFloats r3 = eight(load_four(at(3)), load_four(at(7)));
    const EightFloats xy01 = __builtin_shufflevector(r0, r1, 0, 8, 1, 9, 4, 12, 5, 13);
    const EightFloats xy23 = __builtin_shufflevector(r2, r3, 0, 8, 1, 9, 4, 12, 5, 13);
    const EightFloats zw01 = __builtin_shufflevector(r0, r1, 2, 10, 3, 11, 6, 14, 7, 15);
    const EightFloats zw23 = __builtin_shufflevector(r2, r3, 2, 10, 3, 11, 6, 14, 7, 15);
    x = __builtin_shufflevector(xy01, xy23, 0, 1, 8, 9, 4, 5, 12, 13);
    y = __builtin_shufflevector(xy01, xy23, 2, 3, 10, 11, 6, 7, 14, 15);
    z = __builtin_shufflevector(zw01, zw23, 0, 1, 8, 9, 4, 5, 12, 13);
    w = __builtin_shufflevector(zw01, zw23, 2, 3, 10, 11, 6, 7, 14, 15);
}

CAROM_INLINE void store_halves(void* low, void* high, EightFloats r)
{
    store(low, _mm256_castps256_ps128(r));
    store(high, _mm256_extractf128_ps(r, 1));
}

/// The inverse of gather.
template <class At>
CAROM_INLINE void scatter(const At& at, EightFloats x, EightFloats y, EightFloats z, EightFloats w)
{
    const EightFloats xy02 = __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13);   // x0 y0 x1 y1 | x4 y4 x5 y5
    const EightFloats xy13 = __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15); // x2 y2 x3 y3 | x6 y6 x7 y7
    const EightFloats zw02 = __builtin_shufflevector(z, w, 0, 8, 1, 9, 4, 12, 5, 13);
    const EightFloats zw13 = __builtin_shufflevector(z, w, 2, 10, 3, 11, 6, 14, 7, 15);
    store_halves(at(0), at(4), __builtin_shufflevector(xy02, zw02, 0, 1, 8, 9, 4, 5, 12, 13));
    store_halves(at(1), at(5), __builtin_shufflevector(xy02, zw02, 2, 3, 10, 11, 6, 7, 14, 15));
    store_halves(at(2), at(6), __builtin_shufflevector(xy13, zw13, 0, 1, 8, 9, 4, 5, 12, 13));
    store_halves(at(3), at(7), __builtin_shufflevector(xy13, zw13, 2, 3, 10, 11, 6, 7, 14, 15));
}

} // namespace carom::internal::lanes
