#pragma once

// Compiler extensions, under one name each. The lane backends (core/lanes/) are the only other place for anything that is not ISO C++. A compiler
// that is not named here gets plain C++.

#include <cstddef>
#include <cstdint>

#if defined(_MSC_VER)
#include <intrin.h>
#endif

#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error "Carom needs floats that are rounded to floats: on 32-bit x86 compile with -msse2 -mfpmath=sse"
#endif

// CAROM_GNU: the extensions of GCC, which Clang has too, even as a replacement for MSVC.
#if defined(__GNUC__) || defined(__clang__)
#define CAROM_GNU 1
#else
#define CAROM_GNU 0
#endif

// CAROM_INLINE: a function that is inlined whatever its size.
#if CAROM_GNU
#define CAROM_INLINE inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define CAROM_INLINE __forceinline
#else
#define CAROM_INLINE inline
#endif

// CAROM_X86: the processor has SSE2, and may have more.
#if defined(__x86_64__) || defined(_M_X64)
#define CAROM_X86 1
#else
#define CAROM_X86 0
#endif

// CAROM_HAS_AVX_KERNELS: the engine is built with kernels for AVX2 and AVX-512 besides those for SSE2. CMake defines CAROM_WITH_AVX where it passes the
// options for them.
#if defined(CAROM_WITH_AVX) && CAROM_X86 && CAROM_GNU && !defined(CAROM_SCALAR_LANES)
#define CAROM_HAS_AVX_KERNELS 1
#else
#define CAROM_HAS_AVX_KERNELS 0
#endif

namespace carom::internal {

/// Prefetches the cache line at an address into the second-level cache.
CAROM_INLINE void prefetch_line([[maybe_unused]] const void* place)
{
#if CAROM_GNU
    __builtin_prefetch(place, 0, 2);
#elif defined(_MSC_VER) && defined(_M_X64)
    _mm_prefetch(static_cast<const char*>(place), _MM_HINT_T1);
#endif
}

#if CAROM_HAS_AVX_KERNELS

#if defined(_MSC_VER)

/// The processor's feature bits (cpuid, leaf 7) if the system saves the given parts of its registers (xgetbv), else none.
inline unsigned extended_features(unsigned kept_registers)
{
    int answer[4];
    __cpuidex(answer, 0, 0);
    const bool has_leaf = answer[0] >= 7;
    __cpuidex(answer, 1, 0);
    const bool has_xgetbv = (static_cast<unsigned>(answer[2]) >> 27 & 1u) != 0;
    if (!has_leaf || !has_xgetbv || (_xgetbv(0) & kept_registers) != kept_registers)
        return 0;
    __cpuidex(answer, 7, 0);
    return static_cast<unsigned>(answer[1]);
}
/// Whether processor and system can run code compiled for AVX2, and below for AVX-512 with vectors of every length.
inline bool has_avx2() { return (extended_features(0x6) >> 5 & 1u) != 0; }
inline bool has_avx512()
{
    const unsigned features = extended_features(0xe6);
    return (features >> 16 & features >> 31 & 1u) != 0;
}

#else

/// Whether processor and system can run code compiled for AVX2, and below for AVX-512 with vectors of every length.
inline bool has_avx2()
{
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx2") != 0;
}
inline bool has_avx512()
{
    __builtin_cpu_init();
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0;
}

#endif

#endif

} // namespace carom::internal
