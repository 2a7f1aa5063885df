#pragma once

// Eight lanes as two registers of four, for every machine without wider ones. See registers.h.

#include "core/compiler.h"

namespace carom::internal::lanes {

using EightFloats = Halves<FourFloats>;
using EightInts = Halves<FourInts>;
using EightDoubles = Halves<Halves<TwoDoubles>>;

template <class Number>
CAROM_INLINE auto eight(Number a, Number b, Number c, Number d, Number e, Number f, Number g, Number h)
{
    return Halves{four(a, b, c, d), four(e, f, g, h)};
}
CAROM_INLINE EightDoubles eight(double a, double b, double c, double d, double e, double f, double g, double h)
{
    return {{two(a, b), two(c, d)}, {two(e, f), two(g, h)}};
}
CAROM_INLINE EightFloats eight(FourFloats a, FourFloats b) { return {a, b}; }

CAROM_INLINE EightFloats load_aligned_eight(const float* p) { return {load_aligned_four(p), load_aligned_four(p + 4)}; }
CAROM_INLINE EightInts load_aligned_eight(const std::int32_t* p) { return {load_aligned_four(p), load_aligned_four(p + 4)}; }
template <class Number, class Four>
CAROM_INLINE void store_aligned(Number* p, Halves<Four> v)
{
    store(p, v.low);
    store(p + 4, v.high);
}

CAROM_INLINE EightFloats even_lanes(FourFloats a, FourFloats b, FourFloats c, FourFloats d)
{
    return {even_lanes(a, b), even_lanes(c, d)};
}
CAROM_INLINE EightFloats odd_lanes(FourFloats a, FourFloats b, FourFloats c, FourFloats d)
{
    return {odd_lanes(a, b), odd_lanes(c, d)};
}

/// Four rows become four columns.
CAROM_INLINE void transpose(FourFloats& a, FourFloats& b, FourFloats& c, FourFloats& d)
{
    const FourFloats ab_low = interleaved_low(a, b);
    const FourFloats ab_high = interleaved_high(a, b);
    const FourFloats cd_low = interleaved_low(c, d);
    const FourFloats cd_high = interleaved_high(c, d);
    a = low_halves(ab_low, cd_low);
    b = high_halves(ab_low, cd_low);
    c = low_halves(ab_high, cd_high);
    d = high_halves(ab_high, cd_high);
}

template <class At>
CAROM_INLINE void gather_four(const At& at, int first, FourFloats& a, FourFloats& b, FourFloats& c, FourFloats& d)
{
    a = load_four(at(first));
    b = load_four(at(first + 1));
    c = load_four(at(first + 2));
    d = load_four(at(first + 3));
    transpose(a, b, c, d);
}

template <class At>
CAROM_INLINE void scatter_four(const At& at, int first, FourFloats a, FourFloats b, FourFloats c, FourFloats d)
{
    transpose(a, b, c, d);
    store(at(first), a);
    store(at(first + 1), b);
    store(at(first + 2), c);
    store(at(first + 3), d);
}

/// Eight records of four floats, at(0) to at(7), become four columns.
template <class At>
CAROM_INLINE void gather(const At& at, EightFloats& x, EightFloats& y, EightFloats& z, EightFloats& w)
{
    gather_four(at, 0, x.low, y.low, z.low, w.low);
    gather_four(at, 4, x.high, y.high, z.high, w.high);
}

/// The inverse of gather.
template <class At>
CAROM_INLINE void scatter(const At& at, EightFloats x, EightFloats y, EightFloats z, EightFloats w)
{
    scatter_four(at, 0, x.low, y.low, z.low, w.low);
    scatter_four(at, 4, x.high, y.high, z.high, w.high);
}

} // namespace carom::internal::lanes
