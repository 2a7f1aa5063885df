#pragma once

// Eight floats that are calculated with at once, on GCC's and Clang's vector extensions: one register where the machine has them that wide,
// two or four elsewhere (by lane_halves.h where g++ would part them lane by lane). The same source gives the same bits everywhere: each lane is computed by itself, with the operations written.
// Minimum and maximum are comparisons. Only kernels that are compiled once per instruction set include this file (see dynamics/wide/):
// everything in it is inlined, so that no copy made for one machine is called on another.

#include "core/float4.h"
#include "core/lanes.h"
#include "core/trigonometry.h"

#include <cstdint>
#include <cstring>
#include <type_traits>

#if defined(__AVX__) || defined(__clang__)
#define CAROM_EIGHTS_ARE_WHOLE 1
#else
#define CAROM_EIGHTS_ARE_WHOLE 0
#include "core/lane_halves.h"
#endif

namespace carom::internal {

#if CAROM_EIGHTS_ARE_WHOLE

using F8 = float __attribute__((vector_size(32)));
using I8 = std::int32_t __attribute__((vector_size(32)));
using D8 = double __attribute__((vector_size(64)));
using D4 = double __attribute__((vector_size(32)));

CAROM_INLINE F8 eight_of(float a, float b, float c, float d, float e, float f, float g, float h)
{
    return F8{a, b, c, d, e, f, g, h};
}
CAROM_INLINE I8 eight_of(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d, std::int32_t e, std::int32_t f,
                         std::int32_t g, std::int32_t h)
{
    return I8{a, b, c, d, e, f, g, h};
}
CAROM_INLINE D8 eight_of(double a, double b, double c, double d, double e, double f, double g, double h)
{
    return D8{a, b, c, d, e, f, g, h};
}
CAROM_INLINE F8 all(float x) { return F8{x, x, x, x, x, x, x, x}; }
CAROM_INLINE D8 doubles(F8 x) { return __builtin_convertvector(x, D8); }
CAROM_INLINE F8 floats(D8 x) { return __builtin_convertvector(x, F8); }

/// Each lane is a where the mask is set (-1), b where it is clear (0).
CAROM_INLINE F8 select(I8 mask, F8 a, F8 b) { return mask ? a : b; }
CAROM_INLINE F8 least(F8 a, F8 b) { return a < b ? a : b; }
CAROM_INLINE F8 greatest(F8 a, F8 b) { return a > b ? a : b; }

CAROM_INLINE F8 root(F8 x)
{
    F8 r;
    for (int i = 0; i < lane_count; ++i)
        r[i] = __builtin_sqrtf(x[i]);
    return r;
}

CAROM_INLINE D4 root(D4 x)
{
    D4 r;
    for (int i = 0; i < 4; ++i)
        r[i] = __builtin_sqrt(x[i]);
    return r;
}

// By halves: the kernels of all machines have registers for these.
CAROM_INLINE D8 root(D8 x)
{
    const D4 first = root(__builtin_shufflevector(x, x, 0, 1, 2, 3));
    const D4 second = root(__builtin_shufflevector(x, x, 4, 5, 6, 7));
    return __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// As arc_tangent of trigonometry.h, the same bits, then rounded to floats.
CAROM_INLINE F8 arc_tangent(F8 sine, F8 cosine)
{
    constexpr int most_halvings = 3; // two, and one that rounding may ask for
    const D8 y = __builtin_convertvector(sine, D8);
    const D8 x = __builtin_convertvector(cosine, D8);
    const D8 ax = x < 0.0 ? -x : x;
    const D8 ay = y < 0.0 ? -y : y;
    const auto flat = ay <= ax;
    const D8 longer = flat ? ax : ay;
    D8 t = (flat ? ay : ax) / (longer == 0.0 ? D8{} + 1.0 : longer);
    D8 whole = D8{} + 1.0;
    for (int i = 0; i < most_halvings; ++i)
    {
        const auto wide = t > tan_of_sixteenth;
        t = wide ? t / (1.0 + root(1.0 + t * t)) : t;
        whole = wide ? whole * 2.0 : whole;
    }
    const D8 unit = whole * atan_small(t);
    const D8 angle = flat ? unit : half_pi - unit;
    const D8 upper = x < 0.0 ? 2 * half_pi - angle : angle;
    return __builtin_convertvector(y < 0.0 ? -upper : upper, F8);
}

/// A bit for each lane of a comparison that holds.
CAROM_INLINE unsigned bits(I8 mask)
{
#if defined(__AVX__)
    F8 signs;
    std::memcpy(&signs, &mask, sizeof signs);
    return static_cast<unsigned>(__builtin_ia32_movmskps256(signs));
#else
    const I4 low = __builtin_shufflevector(mask, mask, 0, 1, 2, 3);
    const I4 high = __builtin_shufflevector(mask, mask, 4, 5, 6, 7);
    return bits(low) | bits(high) << 4;
#endif
}

/// Each value(i) is a vector of two doubles: lane i of `first` is its first one, rounded, lane i of `second` its second.
template <class Value>
CAROM_INLINE void round_pairs(const Value& value, F8& first, F8& second)
{
    const auto two = [&](int i)
    {
        const D4 pairs = __builtin_shufflevector(value(i), value(i + 1), 0, 1, 2, 3);
        return __builtin_convertvector(pairs, F4);
    };
    const F8 a = __builtin_shufflevector(two(0), two(4), 0, 1, 2, 3, 4, 5, 6, 7);
    const F8 b = __builtin_shufflevector(two(2), two(6), 0, 1, 2, 3, 4, 5, 6, 7);
    first = __builtin_shufflevector(a, b, 0, 2, 8, 10, 4, 6, 12, 14);
    second = __builtin_shufflevector(a, b, 1, 3, 9, 11, 5, 7, 13, 15);
}

/// Eight records of four floats become four vectors of eight lanes. Lane i is what `at(i)` points to.
template <class At>
CAROM_INLINE void gather4(const At& at, F8& x, F8& y, F8& z, F8& w)
{
    const auto pair = [&](int i, int j)
    {
        F4 lo;
        F4 hi;
        std::memcpy(&lo, at(i), sizeof lo);
        std::memcpy(&hi, at(j), sizeof hi);
        return __builtin_shufflevector(lo, hi, 0, 1, 2, 3, 4, 5, 6, 7);
    };
    const F8 r0 = pair(0, 4);
    const F8 r1 = pair(1, 5);
    const F8 r2 = pair(2, 6);
    const F8 r3 = pair(3, 7);
    const F8 xy01 = __builtin_shufflevector(r0, r1, 0, 8, 1, 9, 4, 12, 5, 13);
    const F8 xy23 = __builtin_shufflevector(r2, r3, 0, 8, 1, 9, 4, 12, 5, 13);
    const F8 zw01 = __builtin_shufflevector(r0, r1, 2, 10, 3, 11, 6, 14, 7, 15);
    const F8 zw23 = __builtin_shufflevector(r2, r3, 2, 10, 3, 11, 6, 14, 7, 15);
    x = __builtin_shufflevector(xy01, xy23, 0, 1, 8, 9, 4, 5, 12, 13);
    y = __builtin_shufflevector(xy01, xy23, 2, 3, 10, 11, 6, 7, 14, 15);
    z = __builtin_shufflevector(zw01, zw23, 0, 1, 8, 9, 4, 5, 12, 13);
    w = __builtin_shufflevector(zw01, zw23, 2, 3, 10, 11, 6, 7, 14, 15);
}

/// And back.
template <class At>
CAROM_INLINE void scatter4(const At& at, F8 x, F8 y, F8 z, F8 w)
{
    const F8 xy02 = __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13);   // x0 y0 x1 y1 | x4 y4 x5 y5
    const F8 xy13 = __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15); // x2 y2 x3 y3 | x6 y6 x7 y7
    const F8 zw02 = __builtin_shufflevector(z, w, 0, 8, 1, 9, 4, 12, 5, 13);
    const F8 zw13 = __builtin_shufflevector(z, w, 2, 10, 3, 11, 6, 14, 7, 15);
    const F8 r0 = __builtin_shufflevector(xy02, zw02, 0, 1, 8, 9, 4, 5, 12, 13);
    const F8 r1 = __builtin_shufflevector(xy02, zw02, 2, 3, 10, 11, 6, 7, 14, 15);
    const F8 r2 = __builtin_shufflevector(xy13, zw13, 0, 1, 8, 9, 4, 5, 12, 13);
    const F8 r3 = __builtin_shufflevector(xy13, zw13, 2, 3, 10, 11, 6, 7, 14, 15);
    const auto split = [&](int i, int j, F8 r)
    {
        const F4 lo = __builtin_shufflevector(r, r, 0, 1, 2, 3);
        const F4 hi = __builtin_shufflevector(r, r, 4, 5, 6, 7);
        std::memcpy(at(i), &lo, sizeof lo);
        std::memcpy(at(j), &hi, sizeof hi);
    };
    split(0, 4, r0);
    split(1, 5, r1);
    split(2, 6, r2);
    split(3, 7, r3);
}

#else

/// As arc_tangent of trigonometry.h, rounded to floats.
CAROM_INLINE F8 arc_tangent(F8 sine, F8 cosine)
{
    const auto lane = [&](int i)
    { return static_cast<float>(arc_tangent(static_cast<double>(sine[i]), static_cast<double>(cosine[i]))); };
    return eight_of(lane(0), lane(1), lane(2), lane(3), lane(4), lane(5), lane(6), lane(7));
}

#endif

/// Aligned as LaneFloats are.
CAROM_INLINE F8 load(const float* eight)
{
    F8 r;
    std::memcpy(&r, __builtin_assume_aligned(eight, 32), sizeof r);
    return r;
}
CAROM_INLINE F8 load(const LaneFloats& a) { return load(a.v); }
CAROM_INLINE I8 load(const LaneInts& a)
{
    I8 r;
    std::memcpy(&r, __builtin_assume_aligned(a.v, 32), sizeof r);
    return r;
}
CAROM_INLINE void store(LaneFloats& a, F8 x) { std::memcpy(__builtin_assume_aligned(a.v, 32), &x, sizeof x); }

CAROM_INLINE void store(LaneInts& a, I8 x) { std::memcpy(__builtin_assume_aligned(a.v, 32), &x, sizeof x); }

CAROM_INLINE I8 all_ints(std::uint32_t x)
{
    const auto i = static_cast<std::int32_t>(x);
    return eight_of(i, i, i, i, i, i, i, i);
}

/// The same bits: flags that were gathered beside floats.
CAROM_INLINE I8 as_ints(F8 bits_of)
{
    I8 r;
    std::memcpy(&r, &bits_of, sizeof r);
    return r;
}

CAROM_INLINE F8 magnitude(F8 x) { return greatest(x, -x); }
CAROM_INLINE F8 clamp(F8 x, F8 low, F8 high) { return least(greatest(x, low), high); }

/// Lane i is value(i), a float or an int. Put together in registers: eight numbers that have just been written one by one are waited for when they are
/// read as one.
template <class Value>
CAROM_INLINE auto lanes_from(const Value& value)
{
    return eight_of(value(0), value(1), value(2), value(3), value(4), value(5), value(6), value(7));
}

/// Two eights in flight: while the one waits for its last result, the other is calculated. A kernel written for F lanes, F8 or Twice<F8>, does the same
/// to each. V is F8 or I8.
template <class V>
struct Twice
{
    V first;
    V second;

    CAROM_INLINE Twice() = default;
    CAROM_INLINE Twice(V a, V b) : first(a), second(b) {}
    CAROM_INLINE Twice(float x) : first(all(x)), second(all(x)) {}

    friend CAROM_INLINE Twice operator+(Twice a, Twice b) { return {a.first + b.first, a.second + b.second}; }
    friend CAROM_INLINE Twice operator-(Twice a, Twice b) { return {a.first - b.first, a.second - b.second}; }
    friend CAROM_INLINE Twice operator*(Twice a, Twice b) { return {a.first * b.first, a.second * b.second}; }
    friend CAROM_INLINE Twice operator/(Twice a, Twice b) { return {a.first / b.first, a.second / b.second}; }
    friend CAROM_INLINE Twice operator&(Twice a, Twice b) { return {a.first & b.first, a.second & b.second}; }
    friend CAROM_INLINE Twice operator|(Twice a, Twice b) { return {a.first | b.first, a.second | b.second}; }
    friend CAROM_INLINE Twice operator-(Twice a) { return {-a.first, -a.second}; }
    friend CAROM_INLINE Twice<I8> operator<(Twice a, Twice b) { return {a.first < b.first, a.second < b.second}; }
    friend CAROM_INLINE Twice<I8> operator>(Twice a, Twice b) { return {a.first > b.first, a.second > b.second}; }
    friend CAROM_INLINE Twice<I8> operator==(Twice a, Twice b) { return {a.first == b.first, a.second == b.second}; }
    friend CAROM_INLINE Twice<I8> operator>=(Twice a, Twice b) { return {a.first >= b.first, a.second >= b.second}; }
    CAROM_INLINE Twice& operator+=(Twice b) { return *this = *this + b; }
    CAROM_INLINE Twice& operator-=(Twice b) { return *this = *this - b; }
};

template <class F>
CAROM_INLINE F all(float x)
{
    if constexpr (std::is_same_v<F, F8>)
        return all(x);
    else
        return F(x);
}

CAROM_INLINE Twice<F8> select(Twice<I8> mask, Twice<F8> a, Twice<F8> b)
{
    return {select(mask.first, a.first, b.first), select(mask.second, a.second, b.second)};
}
CAROM_INLINE Twice<F8> least(Twice<F8> a, Twice<F8> b) { return {least(a.first, b.first), least(a.second, b.second)}; }
CAROM_INLINE Twice<F8> greatest(Twice<F8> a, Twice<F8> b) { return {greatest(a.first, b.first), greatest(a.second, b.second)}; }
CAROM_INLINE Twice<F8> clamp(Twice<F8> x, Twice<F8> low, Twice<F8> high) { return least(greatest(x, low), high); }

} // namespace carom::internal
