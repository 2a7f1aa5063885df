#pragma once

// Vectors of eight floats, in one register or in two (core/lanes/registers.h). The same source gives the same bits everywhere: each lane is computed by
// itself, with the operations as written. Only kernels that are compiled once per instruction set include this file (see
// dynamics/solver/simd/). Everything in it is inlined, so that no copy compiled for one machine is called on another.

#include "core/float4.h"
#include "core/lane_storage.h"
#include "core/trigonometry.h"

#include <cstdint>

namespace carom::internal {

using F8 = Floats<lanes::EightFloats>;
using I8 = Ints<lanes::EightInts>;
using D8 = Doubles<lanes::EightDoubles>;

// Two vectors of eight in flight: while one waits for its last result, the other is computed.
using F16 = Floats<lanes::Halves<lanes::EightFloats>>;
using I16 = Ints<lanes::Halves<lanes::EightInts>>;
CAROM_INLINE F16 sixteen_of(F8 a, F8 b) { return lanes::Halves{a.v, b.v}; }
CAROM_INLINE I16 sixteen_of(I8 a, I8 b) { return lanes::Halves{a.v, b.v}; }
CAROM_INLINE F8 first_eight(F16 x) { return x.v.low; }
CAROM_INLINE F8 second_eight(F16 x) { return x.v.high; }
CAROM_INLINE I8 first_eight(I16 x) { return x.v.low; }
CAROM_INLINE I8 second_eight(I16 x) { return x.v.high; }

CAROM_INLINE F8 eight_of(float a, float b, float c, float d, float e, float f, float g, float h)
{
    return lanes::eight(a, b, c, d, e, f, g, h);
}
CAROM_INLINE I8 eight_of(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d, std::int32_t e, std::int32_t f,
                         std::int32_t g, std::int32_t h)
{
    return lanes::eight(a, b, c, d, e, f, g, h);
}
CAROM_INLINE D8 eight_of(double a, double b, double c, double d, double e, double f, double g, double h)
{
    return lanes::eight(a, b, c, d, e, f, g, h);
}
CAROM_INLINE F8 all(float x) { return x; }
CAROM_INLINE I8 all_ints(std::uint32_t x)
{
    const auto i = static_cast<std::int32_t>(x);
    return eight_of(i, i, i, i, i, i, i, i);
}

CAROM_INLINE unsigned bits(I8 mask) { return lanes::signs(mask.v); } ///< one bit per lane, set where a comparison holds

// Pointers are aligned as LaneFloats are.
CAROM_INLINE F8 load(const float* eight) { return lanes::load_aligned_eight(eight); }
CAROM_INLINE F8 load(const LaneFloats& a) { return load(a.v); }
CAROM_INLINE I8 load(const LaneInts& a) { return lanes::load_aligned_eight(a.v); }
CAROM_INLINE void store(LaneFloats& a, F8 x) { lanes::store_aligned(a.v, x.v); }
CAROM_INLINE void store(LaneInts& a, I8 x) { lanes::store_aligned(a.v, x.v); }

/// Eight records of four floats become four vectors of eight lanes. Lane i is from the record that `at(i)` points to.
template <class At>
CAROM_INLINE void gather4(const At& at, F8& x, F8& y, F8& z, F8& w)
{
    lanes::gather(at, x.v, y.v, z.v, w.v);
}

/// The inverse of gather4.
template <class At>
CAROM_INLINE void scatter4(const At& at, F8 x, F8 y, F8 z, F8 w)
{
    lanes::scatter(at, x.v, y.v, z.v, w.v);
}

/// Each value(i) is a pair of doubles. Lane i of `first` is its first one, rounded; lane i of `second` its second.
template <class Value>
CAROM_INLINE void round_pairs(const Value& value, F8& first, F8& second)
{
    const auto a = lanes::to_floats(lanes::Halves{value(0).v, value(1).v});
    const auto b = lanes::to_floats(lanes::Halves{value(2).v, value(3).v});
    const auto c = lanes::to_floats(lanes::Halves{value(4).v, value(5).v});
    const auto d = lanes::to_floats(lanes::Halves{value(6).v, value(7).v});
    first = lanes::even_lanes(a, b, c, d);
    second = lanes::odd_lanes(a, b, c, d);
}

/// Lane i is value(i), a float or an int. The vector is built in registers: a wide load of eight numbers that have just been stored one by one would stall.
template <class Value>
CAROM_INLINE auto lanes_from(const Value& value)
{
    return eight_of(value(0), value(1), value(2), value(3), value(4), value(5), value(6), value(7));
}

/// The same bits as arc_tangent of trigonometry.h, then rounded to floats.
CAROM_INLINE F8 arc_tangent(F8 sine, F8 cosine)
{
    constexpr int most_halvings = 3; // two, and one more that rounding may require
    const D8 nothing = 0.0;
    const D8 one = 1.0;
    const D8 y = doubles(sine);
    const D8 x = doubles(cosine);
    const D8 ax = select(x < nothing, -x, x);
    const D8 ay = select(y < nothing, -y, y);
    const auto flat = ay <= ax;
    const D8 longer = select(flat, ax, ay);
    D8 t = select(flat, ay, ax) / select(longer == nothing, one, longer);
    D8 whole = one;
    for (int i = 0; i < most_halvings; ++i)
    {
        const auto wide = t > D8(tan_of_sixteenth);
        t = select(wide, t / (one + root(one + t * t)), t);
        whole = select(wide, whole * 2.0, whole);
    }
    const D8 first_octant = whole * atan_small(t);
    const D8 angle = select(flat, first_octant, half_pi - first_octant);
    const D8 upper = select(x < nothing, 2 * half_pi - angle, angle);
    return floats(select(y < nothing, -upper, upper));
}

} // namespace carom::internal
