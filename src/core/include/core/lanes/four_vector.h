#pragma once

// Registers of four lanes on the vector extensions of GCC and Clang: NEON, WebAssembly's SIMD, and other targets of these compilers. See registers.h.

#include "core/lanes/halves.h"

#include <cstdint>
#include <cstring>
#if defined(__aarch64__)
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#include <wasm_simd128.h>
#endif

namespace carom::internal::lanes {

/// The name of kernels that use no wider registers.
#if defined(__aarch64__)
inline constexpr const char* baseline_name = "neon";
#elif defined(__wasm_simd128__)
inline constexpr const char* baseline_name = "wasm";
#else
inline constexpr const char* baseline_name = "vector";
#endif

using FourFloats = float __attribute__((vector_size(16)));
using FourInts = std::int32_t __attribute__((vector_size(16)));
using TwoDoubles = double __attribute__((vector_size(16)));
using TwoLongs = std::int64_t __attribute__((vector_size(16)));

CAROM_INLINE FourFloats four(float a, float b, float c, float d) { return FourFloats{a, b, c, d}; }
CAROM_INLINE FourInts four(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) { return FourInts{a, b, c, d}; }
CAROM_INLINE TwoDoubles two(double a, double b) { return TwoDoubles{a, b}; }
CAROM_INLINE void spread(float x, FourFloats& r) { r = FourFloats{x, x, x, x}; }
CAROM_INLINE void spread(double x, TwoDoubles& r) { r = TwoDoubles{x, x}; }

CAROM_INLINE FourFloats load_four(const void* p) { return read<FourFloats>(p); }
CAROM_INLINE FourFloats load_aligned_four(const float* p) { return read<FourFloats>(__builtin_assume_aligned(p, 16)); }
CAROM_INLINE FourInts load_aligned_four(const std::int32_t* p) { return read<FourInts>(__builtin_assume_aligned(p, 16)); }
CAROM_INLINE TwoDoubles load_two(const double* p) { return read<TwoDoubles>(p); }
CAROM_INLINE void store(void* p, FourFloats v) { std::memcpy(p, &v, sizeof v); }
CAROM_INLINE void store(void* p, FourInts v) { std::memcpy(p, &v, sizeof v); }
CAROM_INLINE void store(void* p, TwoDoubles v) { std::memcpy(p, &v, sizeof v); }

CAROM_INLINE FourFloats add(FourFloats a, FourFloats b) { return a + b; }
CAROM_INLINE FourFloats subtract(FourFloats a, FourFloats b) { return a - b; }
CAROM_INLINE FourFloats multiply(FourFloats a, FourFloats b) { return a * b; }
CAROM_INLINE FourFloats divide(FourFloats a, FourFloats b) { return a / b; }
CAROM_INLINE FourFloats negated(FourFloats a) { return -a; }

CAROM_INLINE TwoDoubles add(TwoDoubles a, TwoDoubles b) { return a + b; }
CAROM_INLINE TwoDoubles subtract(TwoDoubles a, TwoDoubles b) { return a - b; }
CAROM_INLINE TwoDoubles multiply(TwoDoubles a, TwoDoubles b) { return a * b; }
CAROM_INLINE TwoDoubles divide(TwoDoubles a, TwoDoubles b) { return a / b; }
CAROM_INLINE TwoDoubles negated(TwoDoubles a) { return -a; }

CAROM_INLINE FourInts are_less(FourFloats a, FourFloats b) { return a < b; }
CAROM_INLINE FourInts are_at_most(FourFloats a, FourFloats b) { return a <= b; }
CAROM_INLINE FourInts are_equal(FourFloats a, FourFloats b) { return a == b; }
CAROM_INLINE FourInts differ(FourFloats a, FourFloats b) { return a != b; }
CAROM_INLINE FourInts are_less(FourInts a, FourInts b) { return a < b; }
CAROM_INLINE FourInts are_equal(FourInts a, FourInts b) { return a == b; }
CAROM_INLINE TwoLongs are_less(TwoDoubles a, TwoDoubles b) { return a < b; }
CAROM_INLINE TwoLongs are_at_most(TwoDoubles a, TwoDoubles b) { return a <= b; }
CAROM_INLINE TwoLongs are_equal(TwoDoubles a, TwoDoubles b) { return a == b; }

CAROM_INLINE FourInts both(FourInts a, FourInts b) { return a & b; }
CAROM_INLINE FourInts either(FourInts a, FourInts b) { return a | b; }
CAROM_INLINE FourInts inverted(FourInts a) { return ~a; }
CAROM_INLINE float first_lane(FourFloats a) { return a[0]; }
CAROM_INLINE FourInts same_bits(FourFloats a) { return read<FourInts>(&a); }

#if defined(__aarch64__)
CAROM_INLINE FourFloats root(FourFloats a) { return vsqrtq_f32(a); }
CAROM_INLINE TwoDoubles root(TwoDoubles a) { return vsqrtq_f64(a); }
CAROM_INLINE FourFloats choose(FourInts mask, FourFloats a, FourFloats b) { return vbslq_f32(vreinterpretq_u32_s32(mask), a, b); }
CAROM_INLINE TwoDoubles choose(TwoLongs mask, TwoDoubles a, TwoDoubles b) { return vbslq_f64(vreinterpretq_u64_s64(mask), a, b); }
CAROM_INLINE unsigned signs(FourInts a)
{
    const FourInts places{1, 2, 4, 8};
    return static_cast<unsigned>(vaddvq_s32(vshrq_n_s32(a, 31) & places));
}
// The machine's own minimum and maximum order zeros, and treat NaN, differently from a comparison.
CAROM_INLINE FourFloats least(FourFloats a, FourFloats b) { return choose(a < b, a, b); }
CAROM_INLINE FourFloats greatest(FourFloats a, FourFloats b) { return choose(a > b, a, b); }
#elif defined(__wasm_simd128__)
CAROM_INLINE FourFloats root(FourFloats a) { return static_cast<FourFloats>(wasm_f32x4_sqrt(static_cast<v128_t>(a))); }
CAROM_INLINE TwoDoubles root(TwoDoubles a) { return static_cast<TwoDoubles>(wasm_f64x2_sqrt(static_cast<v128_t>(a))); }
CAROM_INLINE FourFloats choose(FourInts mask, FourFloats a, FourFloats b) { return mask ? a : b; }
CAROM_INLINE TwoDoubles choose(TwoLongs mask, TwoDoubles a, TwoDoubles b) { return mask ? a : b; }
CAROM_INLINE unsigned signs(FourInts a) { return wasm_i32x4_bitmask(static_cast<v128_t>(a)); }
// pmin(b, a) is a < b ? a : b.
CAROM_INLINE FourFloats least(FourFloats a, FourFloats b)
{
    return static_cast<FourFloats>(wasm_f32x4_pmin(static_cast<v128_t>(b), static_cast<v128_t>(a)));
}
CAROM_INLINE FourFloats greatest(FourFloats a, FourFloats b)
{
    return static_cast<FourFloats>(wasm_f32x4_pmax(static_cast<v128_t>(b), static_cast<v128_t>(a)));
}
#else
CAROM_INLINE FourFloats root(FourFloats a)
{
    return FourFloats{__builtin_sqrtf(a[0]), __builtin_sqrtf(a[1]), __builtin_sqrtf(a[2]), __builtin_sqrtf(a[3])};
}
CAROM_INLINE TwoDoubles root(TwoDoubles a) { return TwoDoubles{__builtin_sqrt(a[0]), __builtin_sqrt(a[1])}; }
CAROM_INLINE FourFloats choose(FourInts mask, FourFloats a, FourFloats b) { return mask ? a : b; }
CAROM_INLINE TwoDoubles choose(TwoLongs mask, TwoDoubles a, TwoDoubles b) { return mask ? a : b; }
CAROM_INLINE unsigned signs(FourInts a)
{
    return (static_cast<unsigned>(a[0]) >> 31) | (static_cast<unsigned>(a[1]) >> 31 << 1) |
           (static_cast<unsigned>(a[2]) >> 31 << 2) | (static_cast<unsigned>(a[3]) >> 31 << 3);
}
CAROM_INLINE FourFloats least(FourFloats a, FourFloats b) { return choose(a < b, a, b); }
CAROM_INLINE FourFloats greatest(FourFloats a, FourFloats b) { return choose(a > b, a, b); }
#endif

CAROM_INLINE TwoDoubles least(TwoDoubles a, TwoDoubles b) { return choose(a < b, a, b); }

#if defined(__aarch64__) // g++ would convert lane by lane
CAROM_INLINE Halves<TwoDoubles> to_doubles(FourFloats a) { return {vcvt_f64_f32(vget_low_f32(a)), vcvt_high_f64_f32(a)}; }
CAROM_INLINE FourFloats to_floats(Halves<TwoDoubles> a) { return vcvt_high_f32_f64(vcvt_f32_f64(a.low), a.high); }
#else
CAROM_INLINE Halves<TwoDoubles> to_doubles(FourFloats a)
{
    using TwoFloats = float __attribute__((vector_size(8)));
    const TwoFloats low = __builtin_shufflevector(a, a, 0, 1);
    const TwoFloats high = __builtin_shufflevector(a, a, 2, 3);
    return {__builtin_convertvector(low, TwoDoubles), __builtin_convertvector(high, TwoDoubles)};
}
CAROM_INLINE FourFloats to_floats(Halves<TwoDoubles> a)
{
    using TwoFloats = float __attribute__((vector_size(8)));
    const TwoFloats low = __builtin_convertvector(a.low, TwoFloats);
    const TwoFloats high = __builtin_convertvector(a.high, TwoFloats);
    return __builtin_shufflevector(low, high, 0, 1, 2, 3);
}
#endif

CAROM_INLINE FourFloats low_halves(FourFloats a, FourFloats b) { return __builtin_shufflevector(a, b, 0, 1, 4, 5); }
CAROM_INLINE FourFloats high_halves(FourFloats a, FourFloats b) { return __builtin_shufflevector(a, b, 2, 3, 6, 7); }
CAROM_INLINE FourFloats low_and_high(FourFloats a, FourFloats b) { return __builtin_shufflevector(a, b, 0, 1, 6, 7); }
CAROM_INLINE FourFloats even_lanes(FourFloats a, FourFloats b) { return __builtin_shufflevector(a, b, 0, 2, 4, 6); }
CAROM_INLINE FourFloats odd_lanes(FourFloats a, FourFloats b) { return __builtin_shufflevector(a, b, 1, 3, 5, 7); }
CAROM_INLINE FourFloats interleaved_low(FourFloats a, FourFloats b) { return __builtin_shufflevector(a, b, 0, 4, 1, 5); }
CAROM_INLINE FourFloats interleaved_high(FourFloats a, FourFloats b) { return __builtin_shufflevector(a, b, 2, 6, 3, 7); }
CAROM_INLINE FourFloats swapped_halves(FourFloats a) { return __builtin_shufflevector(a, a, 2, 3, 0, 1); }
CAROM_INLINE FourFloats swapped_neighbours(FourFloats a) { return __builtin_shufflevector(a, a, 1, 0, 3, 2); }
CAROM_INLINE FourFloats with_last(FourFloats a, FourFloats b) { return __builtin_shufflevector(a, b, 0, 1, 2, 7); }

} // namespace carom::internal::lanes
