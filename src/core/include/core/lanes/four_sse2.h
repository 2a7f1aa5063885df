#pragma once

// Registers of four lanes: SSE2, which every x86-64 processor has. See registers.h.

#include "core/lanes/halves.h"

#include <cstdint>
#include <emmintrin.h>
#if defined(__AVX__)
#include <immintrin.h>
#endif

namespace carom::internal::lanes {

inline constexpr const char* baseline_name = "sse2"; ///< the name of kernels that use no wider registers

#if CAROM_GNU // the intrinsics' types without may_alias, which template arguments do not carry
using FourFloats = float __attribute__((vector_size(16)));
using FourInts = long long __attribute__((vector_size(16)));
using TwoDoubles = double __attribute__((vector_size(16)));
#else
using FourFloats = __m128;
using FourInts = __m128i;
using TwoDoubles = __m128d;
#endif

CAROM_INLINE FourFloats four(float a, float b, float c, float d) { return _mm_setr_ps(a, b, c, d); }
CAROM_INLINE FourInts four(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) { return _mm_setr_epi32(a, b, c, d); }
CAROM_INLINE TwoDoubles two(double a, double b) { return _mm_setr_pd(a, b); }

CAROM_INLINE void spread(float x, FourFloats& r) { r = _mm_set1_ps(x); }
CAROM_INLINE void spread(double x, TwoDoubles& r) { r = _mm_set1_pd(x); }

CAROM_INLINE FourFloats load_four(const void* p) { return _mm_loadu_ps(static_cast<const float*>(p)); }
CAROM_INLINE FourFloats load_aligned_four(const float* p) { return _mm_load_ps(p); }
CAROM_INLINE FourInts load_aligned_four(const std::int32_t* p) { return _mm_load_si128(reinterpret_cast<const __m128i*>(p)); }
CAROM_INLINE TwoDoubles load_two(const double* p) { return _mm_loadu_pd(p); }
CAROM_INLINE void store(void* p, FourFloats v) { _mm_storeu_ps(static_cast<float*>(p), v); }
CAROM_INLINE void store(void* p, FourInts v) { _mm_storeu_si128(static_cast<__m128i*>(p), v); }
CAROM_INLINE void store(void* p, TwoDoubles v) { _mm_storeu_pd(static_cast<double*>(p), v); }

CAROM_INLINE FourFloats add(FourFloats a, FourFloats b) { return _mm_add_ps(a, b); }
CAROM_INLINE FourFloats subtract(FourFloats a, FourFloats b) { return _mm_sub_ps(a, b); }
CAROM_INLINE FourFloats multiply(FourFloats a, FourFloats b) { return _mm_mul_ps(a, b); }
CAROM_INLINE FourFloats divide(FourFloats a, FourFloats b) { return _mm_div_ps(a, b); }
CAROM_INLINE FourFloats negated(FourFloats a) { return _mm_xor_ps(a, _mm_set1_ps(-0.0f)); }
CAROM_INLINE FourFloats root(FourFloats a) { return _mm_sqrt_ps(a); }
CAROM_INLINE FourFloats least(FourFloats a, FourFloats b) { return _mm_min_ps(a, b); }
CAROM_INLINE FourFloats greatest(FourFloats a, FourFloats b) { return _mm_max_ps(a, b); }

CAROM_INLINE TwoDoubles add(TwoDoubles a, TwoDoubles b) { return _mm_add_pd(a, b); }
CAROM_INLINE TwoDoubles subtract(TwoDoubles a, TwoDoubles b) { return _mm_sub_pd(a, b); }
CAROM_INLINE TwoDoubles multiply(TwoDoubles a, TwoDoubles b) { return _mm_mul_pd(a, b); }
CAROM_INLINE TwoDoubles divide(TwoDoubles a, TwoDoubles b) { return _mm_div_pd(a, b); }
CAROM_INLINE TwoDoubles negated(TwoDoubles a) { return _mm_xor_pd(a, _mm_set1_pd(-0.0)); }
CAROM_INLINE TwoDoubles root(TwoDoubles a) { return _mm_sqrt_pd(a); }
CAROM_INLINE TwoDoubles least(TwoDoubles a, TwoDoubles b) { return _mm_min_pd(a, b); }

CAROM_INLINE FourInts are_less(FourFloats a, FourFloats b) { return _mm_castps_si128(_mm_cmplt_ps(a, b)); }
CAROM_INLINE FourInts are_at_most(FourFloats a, FourFloats b) { return _mm_castps_si128(_mm_cmple_ps(a, b)); }
CAROM_INLINE FourInts are_equal(FourFloats a, FourFloats b) { return _mm_castps_si128(_mm_cmpeq_ps(a, b)); }
CAROM_INLINE FourInts differ(FourFloats a, FourFloats b) { return _mm_castps_si128(_mm_cmpneq_ps(a, b)); }
CAROM_INLINE FourInts are_less(FourInts a, FourInts b) { return _mm_cmplt_epi32(a, b); }
CAROM_INLINE FourInts are_equal(FourInts a, FourInts b) { return _mm_cmpeq_epi32(a, b); }
CAROM_INLINE TwoDoubles are_less(TwoDoubles a, TwoDoubles b) { return _mm_cmplt_pd(a, b); }
CAROM_INLINE TwoDoubles are_at_most(TwoDoubles a, TwoDoubles b) { return _mm_cmple_pd(a, b); }
CAROM_INLINE TwoDoubles are_equal(TwoDoubles a, TwoDoubles b) { return _mm_cmpeq_pd(a, b); }

CAROM_INLINE FourInts both(FourInts a, FourInts b) { return _mm_and_si128(a, b); }
CAROM_INLINE FourInts either(FourInts a, FourInts b) { return _mm_or_si128(a, b); }
CAROM_INLINE FourInts inverted(FourInts a) { return _mm_xor_si128(a, _mm_set1_epi32(-1)); }

CAROM_INLINE FourFloats choose(FourInts mask, FourFloats a, FourFloats b)
{
    const __m128 m = _mm_castsi128_ps(mask);
    return _mm_or_ps(_mm_and_ps(m, a), _mm_andnot_ps(m, b));
}
CAROM_INLINE TwoDoubles choose(TwoDoubles mask, TwoDoubles a, TwoDoubles b)
{
    return _mm_or_pd(_mm_and_pd(mask, a), _mm_andnot_pd(mask, b));
}
CAROM_INLINE float first_lane(FourFloats a) { return _mm_cvtss_f32(a); }
CAROM_INLINE unsigned signs(FourInts a) { return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(a))); }
CAROM_INLINE FourInts same_bits(FourFloats a) { return _mm_castps_si128(a); }

CAROM_INLINE Halves<TwoDoubles> to_doubles(FourFloats a) { return {_mm_cvtps_pd(a), _mm_cvtps_pd(_mm_movehl_ps(a, a))}; }
CAROM_INLINE FourFloats to_floats(Halves<TwoDoubles> a)
{
#if defined(__AVX__)
    return _mm256_cvtpd_ps(_mm256_set_m128d(a.high, a.low));
#else
    return _mm_movelh_ps(_mm_cvtpd_ps(a.low), _mm_cvtpd_ps(a.high));
#endif
}

CAROM_INLINE FourFloats low_halves(FourFloats a, FourFloats b) { return _mm_movelh_ps(a, b); }
CAROM_INLINE FourFloats high_halves(FourFloats a, FourFloats b) { return _mm_movehl_ps(b, a); }
CAROM_INLINE FourFloats low_and_high(FourFloats a, FourFloats b) { return _mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 2, 1, 0)); }
CAROM_INLINE FourFloats even_lanes(FourFloats a, FourFloats b) { return _mm_shuffle_ps(a, b, _MM_SHUFFLE(2, 0, 2, 0)); }
CAROM_INLINE FourFloats odd_lanes(FourFloats a, FourFloats b) { return _mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 1, 3, 1)); }
CAROM_INLINE FourFloats interleaved_low(FourFloats a, FourFloats b) { return _mm_unpacklo_ps(a, b); }
CAROM_INLINE FourFloats interleaved_high(FourFloats a, FourFloats b) { return _mm_unpackhi_ps(a, b); }
CAROM_INLINE FourFloats swapped_halves(FourFloats a) { return _mm_shuffle_ps(a, a, _MM_SHUFFLE(1, 0, 3, 2)); }
CAROM_INLINE FourFloats swapped_neighbours(FourFloats a) { return _mm_shuffle_ps(a, a, _MM_SHUFFLE(2, 3, 0, 1)); }
CAROM_INLINE FourFloats with_last(FourFloats a, FourFloats b)
{
    const FourFloats last = _mm_shuffle_ps(a, b, _MM_SHUFFLE(3, 3, 2, 2));
    return _mm_shuffle_ps(a, last, _MM_SHUFFLE(2, 0, 1, 0));
}

} // namespace carom::internal::lanes
