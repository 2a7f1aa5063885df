#pragma once

// Eight lanes as two halves of four, for compilers that take a vector wider than the machine's registers apart lane by lane, as g++ does: there the
// operations of lane_math.h on whole eights take three to five times as long. Each operation here is one instruction a half, and the same
// operation in each lane, so the bits are those of whole eights. Included by lane_math.h alone.

#include "core/float4.h"

#include <cstdint>
#include <cstring>

namespace carom::internal {

struct I8
{
    I4 low;
    I4 high;
};

struct F8
{
    F4 low;
    F4 high;
    CAROM_INLINE float operator[](int i) const { return i < 4 ? low[i] : high[i - 4]; }
};

/// Eight doubles in four pairs.
struct D8
{
    D2 pairs[4];
};

CAROM_INLINE F8 eight_of(float a, float b, float c, float d, float e, float f, float g, float h)
{
    return {F4{a, b, c, d}, F4{e, f, g, h}};
}
CAROM_INLINE I8 eight_of(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d, std::int32_t e, std::int32_t f,
                         std::int32_t g, std::int32_t h)
{
    return {I4{a, b, c, d}, I4{e, f, g, h}};
}
CAROM_INLINE D8 eight_of(double a, double b, double c, double d, double e, double f, double g, double h)
{
    return {{D2{a, b}, D2{c, d}, D2{e, f}, D2{g, h}}};
}

// Between two eights, and between eight and one number for all of its lanes.
#define CAROM_OF_FLOATS(op)                                                                                                      \
    CAROM_INLINE F8 operator op(F8 a, F8 b) { return {a.low op b.low, a.high op b.high}; }                                       \
    CAROM_INLINE F8 operator op(F8 a, float b) { return {a.low op b, a.high op b}; }                                             \
    CAROM_INLINE F8 operator op(float a, F8 b) { return {a op b.low, a op b.high}; }
CAROM_OF_FLOATS(+)
CAROM_OF_FLOATS(-)
CAROM_OF_FLOATS(*)
CAROM_OF_FLOATS(/)
#undef CAROM_OF_FLOATS
CAROM_INLINE F8 operator-(F8 a) { return {-a.low, -a.high}; }
CAROM_INLINE F8& operator+=(F8& a, F8 b) { return a = a + b; }
CAROM_INLINE F8& operator-=(F8& a, F8 b) { return a = a - b; }
CAROM_INLINE F8& operator*=(F8& a, F8 b) { return a = a * b; }

#define CAROM_OF_DOUBLES(op)                                                                                                     \
    CAROM_INLINE D8 operator op(D8 a, D8 b)                                                                                      \
    {                                                                                                                            \
        return {{a.pairs[0] op b.pairs[0], a.pairs[1] op b.pairs[1], a.pairs[2] op b.pairs[2], a.pairs[3] op b.pairs[3]}};       \
    }
CAROM_OF_DOUBLES(+)
CAROM_OF_DOUBLES(-)
CAROM_OF_DOUBLES(*)
#undef CAROM_OF_DOUBLES
CAROM_INLINE D8& operator-=(D8& a, D8 b) { return a = a - b; }

#define CAROM_COMPARES(op)                                                                                                       \
    CAROM_INLINE I8 operator op(F8 a, F8 b) { return {a.low op b.low, a.high op b.high}; }                                       \
    CAROM_INLINE I8 operator op(F8 a, float b) { return {a.low op b, a.high op b}; }                                             \
    CAROM_INLINE I8 operator op(I8 a, I8 b) { return {a.low op b.low, a.high op b.high}; }                                       \
    CAROM_INLINE I8 operator op(I8 a, std::int32_t b) { return {a.low op b, a.high op b}; }
CAROM_COMPARES(<)
CAROM_COMPARES(>)
CAROM_COMPARES(<=)
CAROM_COMPARES(>=)
CAROM_COMPARES(==)
CAROM_COMPARES(!=)
#undef CAROM_COMPARES

#define CAROM_OF_BITS(op)                                                                                                        \
    CAROM_INLINE I8 operator op(I8 a, I8 b) { return {a.low op b.low, a.high op b.high}; }                                       \
    CAROM_INLINE I8 operator op(I8 a, std::int32_t b) { return {a.low op b, a.high op b}; }
CAROM_OF_BITS(&)
CAROM_OF_BITS(|)
#undef CAROM_OF_BITS
CAROM_INLINE I8 operator~(I8 a) { return {~a.low, ~a.high}; }
CAROM_INLINE I8& operator|=(I8& a, I8 b) { return a = a | b; }
CAROM_INLINE I8& operator&=(I8& a, I8 b) { return a = a & b; }

CAROM_INLINE F8 all(float x) { return eight_of(x, x, x, x, x, x, x, x); }

// g++ makes of a vector's ?: a comparison and three operations; the machine has one for the lesser of two, and needs three for a choice.
#if defined(__SSE2__)
CAROM_INLINE F4 lesser(F4 a, F4 b) { return __builtin_ia32_minps(a, b); }
CAROM_INLINE F4 greater(F4 a, F4 b) { return __builtin_ia32_maxps(a, b); }
#else
CAROM_INLINE F4 lesser(F4 a, F4 b) { return least(a, b); }
CAROM_INLINE F4 greater(F4 a, F4 b) { return greatest(a, b); }
#endif
CAROM_INLINE F4 chosen(I4 mask, F4 a, F4 b)
{
    I4 first;
    I4 second;
    std::memcpy(&first, &a, sizeof a);
    std::memcpy(&second, &b, sizeof b);
    const I4 either = (mask & first) | (~mask & second);
    F4 r;
    std::memcpy(&r, &either, sizeof r);
    return r;
}

/// Each lane is a where the mask is set (-1), b where it is clear (0).
CAROM_INLINE F8 select(I8 mask, F8 a, F8 b) { return {chosen(mask.low, a.low, b.low), chosen(mask.high, a.high, b.high)}; }
CAROM_INLINE F8 least(F8 a, F8 b) { return {lesser(a.low, b.low), lesser(a.high, b.high)}; }
CAROM_INLINE F8 greatest(F8 a, F8 b) { return {greater(a.low, b.low), greater(a.high, b.high)}; }

CAROM_INLINE unsigned bits(I8 mask) { return bits(mask.low) | bits(mask.high) << 4; }

#if defined(__SSE2__)
CAROM_INLINE F4 root(F4 x) { return __builtin_ia32_sqrtps(x); }
CAROM_INLINE D2 root(D2 x) { return __builtin_ia32_sqrtpd(x); }
CAROM_INLINE D2 first_doubles(F4 x) { return __builtin_ia32_cvtps2pd(x); }
CAROM_INLINE F4 rounded(D2 a, D2 b) { return __builtin_ia32_movlhps(__builtin_ia32_cvtpd2ps(a), __builtin_ia32_cvtpd2ps(b)); }
#else
CAROM_INLINE F4 root(F4 x)
{
    return F4{__builtin_sqrtf(x[0]), __builtin_sqrtf(x[1]), __builtin_sqrtf(x[2]), __builtin_sqrtf(x[3])};
}
CAROM_INLINE D2 root(D2 x) { return D2{__builtin_sqrt(x[0]), __builtin_sqrt(x[1])}; }
CAROM_INLINE D2 first_doubles(F4 x) { return D2{static_cast<double>(x[0]), static_cast<double>(x[1])}; }
CAROM_INLINE F4 rounded(D2 a, D2 b)
{
    return F4{static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(b[0]), static_cast<float>(b[1])};
}
#endif

CAROM_INLINE F8 root(F8 x) { return {root(x.low), root(x.high)}; }
CAROM_INLINE D8 root(D8 x) { return {{root(x.pairs[0]), root(x.pairs[1]), root(x.pairs[2]), root(x.pairs[3])}}; }
CAROM_INLINE D8 doubles(F8 x)
{
    return {{first_doubles(x.low), first_doubles(swap_halves(x.low)), first_doubles(x.high), first_doubles(swap_halves(x.high))}};
}
CAROM_INLINE F8 floats(D8 x) { return {rounded(x.pairs[0], x.pairs[1]), rounded(x.pairs[2], x.pairs[3])}; }

/// Each value(i) is a vector of two doubles: lane i of `first` is its first one, rounded, lane i of `second` its second.
template <class Value>
CAROM_INLINE void round_pairs(const Value& value, F8& first, F8& second)
{
    const F4 a = rounded(value(0), value(1));
    const F4 b = rounded(value(2), value(3));
    const F4 c = rounded(value(4), value(5));
    const F4 d = rounded(value(6), value(7));
    first = {__builtin_shufflevector(a, b, 0, 2, 4, 6), __builtin_shufflevector(c, d, 0, 2, 4, 6)};
    second = {__builtin_shufflevector(a, b, 1, 3, 5, 7), __builtin_shufflevector(c, d, 1, 3, 5, 7)};
}

/// Four rows become four columns.
CAROM_INLINE void transpose(F4& a, F4& b, F4& c, F4& d)
{
    const F4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const F4 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const F4 cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const F4 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

/// Eight records of four floats become four vectors of eight lanes. Lane i is what `at(i)` points to.
template <class At>
CAROM_INLINE void gather4(const At& at, F8& x, F8& y, F8& z, F8& w)
{
    const auto four = [&](int first, F4& a, F4& b, F4& c, F4& d)
    {
        std::memcpy(&a, at(first), sizeof a);
        std::memcpy(&b, at(first + 1), sizeof b);
        std::memcpy(&c, at(first + 2), sizeof c);
        std::memcpy(&d, at(first + 3), sizeof d);
        transpose(a, b, c, d);
    };
    four(0, x.low, y.low, z.low, w.low);
    four(4, x.high, y.high, z.high, w.high);
}

/// And back.
template <class At>
CAROM_INLINE void scatter4(const At& at, F8 x, F8 y, F8 z, F8 w)
{
    const auto four = [&](int first, F4 a, F4 b, F4 c, F4 d)
    {
        transpose(a, b, c, d);
        std::memcpy(at(first), &a, sizeof a);
        std::memcpy(at(first + 1), &b, sizeof b);
        std::memcpy(at(first + 2), &c, sizeof c);
        std::memcpy(at(first + 3), &d, sizeof d);
    };
    four(0, x.low, y.low, z.low, w.low);
    four(4, x.high, y.high, z.high, w.high);
}

} // namespace carom::internal
