#pragma once

// Lanes in plain C++: a register is one number, and four lanes are halves of halves. It serves compilers and machines that no other backend covers, and is the
// reference that the others are tested against. See registers.h.

#include "core/lanes/halves.h"

#include <cmath>
#include <cstdint>
#include <cstring>

namespace carom::internal::lanes {

inline constexpr const char* baseline_name = "scalar"; ///< the name of kernels that use no wider registers

using FourFloats = Halves<Halves<float>>;
using FourInts = Halves<Halves<std::int32_t>>;
using TwoDoubles = Halves<double>;

CAROM_INLINE FourFloats four(float a, float b, float c, float d) { return {{a, b}, {c, d}}; }
CAROM_INLINE FourInts four(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) { return {{a, b}, {c, d}}; }
CAROM_INLINE TwoDoubles two(double a, double b) { return {a, b}; }
CAROM_INLINE void spread(float x, float& r) { r = x; }
CAROM_INLINE void spread(double x, double& r) { r = x; }

CAROM_INLINE FourFloats load_four(const void* p) { return read<FourFloats>(p); }
CAROM_INLINE FourFloats load_aligned_four(const float* p) { return read<FourFloats>(p); }
CAROM_INLINE FourInts load_aligned_four(const std::int32_t* p) { return read<FourInts>(p); }
CAROM_INLINE TwoDoubles load_two(const double* p) { return read<TwoDoubles>(p); }
template <class Number>
CAROM_INLINE void store(void* p, Halves<Number> v)
{
    std::memcpy(p, &v.low, sizeof v.low);
    std::memcpy(static_cast<char*>(p) + sizeof v.low, &v.high, sizeof v.high);
}
template <class Number>
CAROM_INLINE void store(void* p, Halves<Halves<Number>> v)
{
    store(p, v.low);
    store(static_cast<char*>(p) + sizeof v.low, v.high);
}

CAROM_INLINE float add(float a, float b) { return a + b; }
CAROM_INLINE float subtract(float a, float b) { return a - b; }
CAROM_INLINE float multiply(float a, float b) { return a * b; }
CAROM_INLINE float divide(float a, float b) { return a / b; }
CAROM_INLINE float negated(float a) { return -a; }
CAROM_INLINE float root(float a) { return std::sqrt(a); }
CAROM_INLINE float least(float a, float b) { return a < b ? a : b; }
CAROM_INLINE float greatest(float a, float b) { return a > b ? a : b; }

CAROM_INLINE double add(double a, double b) { return a + b; }
CAROM_INLINE double subtract(double a, double b) { return a - b; }
CAROM_INLINE double multiply(double a, double b) { return a * b; }
CAROM_INLINE double divide(double a, double b) { return a / b; }
CAROM_INLINE double negated(double a) { return -a; }
CAROM_INLINE double root(double a) { return std::sqrt(a); }
CAROM_INLINE double least(double a, double b) { return a < b ? a : b; }

CAROM_INLINE std::int32_t are_less(float a, float b) { return a < b ? -1 : 0; }
CAROM_INLINE std::int32_t are_at_most(float a, float b) { return a <= b ? -1 : 0; }
CAROM_INLINE std::int32_t are_equal(float a, float b) { return a == b ? -1 : 0; }
CAROM_INLINE std::int32_t differ(float a, float b) { return a != b ? -1 : 0; }
CAROM_INLINE std::int32_t are_less(std::int32_t a, std::int32_t b) { return a < b ? -1 : 0; }
CAROM_INLINE std::int32_t are_equal(std::int32_t a, std::int32_t b) { return a == b ? -1 : 0; }
CAROM_INLINE bool are_less(double a, double b) { return a < b; }
CAROM_INLINE bool are_at_most(double a, double b) { return a <= b; }
CAROM_INLINE bool are_equal(double a, double b) { return a == b; }

CAROM_INLINE std::int32_t both(std::int32_t a, std::int32_t b) { return a & b; }
CAROM_INLINE std::int32_t either(std::int32_t a, std::int32_t b) { return a | b; }
CAROM_INLINE std::int32_t inverted(std::int32_t a) { return ~a; }
CAROM_INLINE std::int32_t same_bits(float a) { return read<std::int32_t>(&a); }
CAROM_INLINE float choose(std::int32_t mask, float a, float b) { return mask != 0 ? a : b; }
CAROM_INLINE double choose(bool mask, double a, double b) { return mask ? a : b; }
CAROM_INLINE double to_doubles(float a) { return static_cast<double>(a); }
CAROM_INLINE float to_floats(double a) { return static_cast<float>(a); }

CAROM_INLINE float first_lane(FourFloats a) { return a.low.low; }

CAROM_INLINE unsigned signs(FourInts a)
{
    const auto sign = [](std::int32_t lane) { return lane < 0 ? 1u : 0u; };
    return sign(a.low.low) | sign(a.low.high) << 1 | sign(a.high.low) << 2 | sign(a.high.high) << 3;
}

CAROM_INLINE FourFloats low_halves(FourFloats a, FourFloats b) { return {a.low, b.low}; }
CAROM_INLINE FourFloats high_halves(FourFloats a, FourFloats b) { return {a.high, b.high}; }
CAROM_INLINE FourFloats low_and_high(FourFloats a, FourFloats b) { return {a.low, b.high}; }
CAROM_INLINE FourFloats even_lanes(FourFloats a, FourFloats b) { return {{a.low.low, a.high.low}, {b.low.low, b.high.low}}; }
CAROM_INLINE FourFloats odd_lanes(FourFloats a, FourFloats b) { return {{a.low.high, a.high.high}, {b.low.high, b.high.high}}; }
CAROM_INLINE FourFloats interleaved_low(FourFloats a, FourFloats b) { return {{a.low.low, b.low.low}, {a.low.high, b.low.high}}; }
CAROM_INLINE FourFloats interleaved_high(FourFloats a, FourFloats b)
{
    return {{a.high.low, b.high.low}, {a.high.high, b.high.high}};
}
CAROM_INLINE FourFloats swapped_halves(FourFloats a) { return {a.high, a.low}; }
CAROM_INLINE FourFloats swapped_neighbours(FourFloats a) { return {{a.low.high, a.low.low}, {a.high.high, a.high.low}}; }
CAROM_INLINE FourFloats with_last(FourFloats a, FourFloats b) { return {a.low, {a.high.low, b.high.high}}; }

} // namespace carom::internal::lanes
