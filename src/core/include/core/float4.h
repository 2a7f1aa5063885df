#pragma once

// Vectors of four floats: every machine that the engine is built for has registers of that size. Vectors of eight, in a kernel
// per instruction set, are in lane_math.h.

#include "core/lanes/vectors.h"

#include <cstdint>

namespace carom::internal {

using F4 = Floats<lanes::FourFloats>;
using I4 = Ints<lanes::FourInts>;
using D2 = Doubles<lanes::TwoDoubles>;

CAROM_INLINE F4 four_of(float a, float b, float c, float d) { return lanes::four(a, b, c, d); }
CAROM_INLINE D2 two_of(double a, double b) { return lanes::two(a, b); }

CAROM_INLINE F4 load4(const float* p) { return lanes::load_four(p); }
CAROM_INLINE D2 load2(const double* p) { return lanes::load_two(p); }
CAROM_INLINE void store4(float* p, F4 v) { lanes::store(p, v.v); }
CAROM_INLINE void store2(double* p, D2 v) { lanes::store(p, v.v); }

CAROM_INLINE float first_lane(F4 a) { return lanes::first_lane(a.v); }
CAROM_INLINE unsigned bits(I4 mask) { return lanes::signs(mask.v); } ///< one bit per lane, set where a comparison holds

// Shuffles, with a = a0 a1 a2 a3.
CAROM_INLINE F4 low_halves(F4 a, F4 b) { return lanes::low_halves(a.v, b.v); }             ///< a0 a1 b0 b1
CAROM_INLINE F4 high_halves(F4 a, F4 b) { return lanes::high_halves(a.v, b.v); }           ///< a2 a3 b2 b3
CAROM_INLINE F4 low_and_high(F4 a, F4 b) { return lanes::low_and_high(a.v, b.v); }         ///< a0 a1 b2 b3
CAROM_INLINE F4 even_lanes(F4 a, F4 b) { return lanes::even_lanes(a.v, b.v); }             ///< a0 a2 b0 b2
CAROM_INLINE F4 odd_lanes(F4 a, F4 b) { return lanes::odd_lanes(a.v, b.v); }               ///< a1 a3 b1 b3
CAROM_INLINE F4 interleaved_high(F4 a, F4 b) { return lanes::interleaved_high(a.v, b.v); } ///< a2 b2 a3 b3
CAROM_INLINE F4 swapped_halves(F4 a) { return lanes::swapped_halves(a.v); }                ///< a2 a3 a0 a1
CAROM_INLINE F4 swapped_neighbours(F4 a) { return lanes::swapped_neighbours(a.v); }        ///< a1 a0 a3 a2
CAROM_INLINE F4 with_last(F4 a, F4 b) { return lanes::with_last(a.v, b.v); }               ///< a0 a1 a2 b3

} // namespace carom::internal
