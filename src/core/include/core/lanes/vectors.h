#pragma once

// Vectors with arithmetic operators, in which kernels are written. R is a register, or Halves of several.

#include "core/lanes/registers.h"

namespace carom::internal {

/// Integers, and results of comparisons: -1 where one holds, 0 where not.
template <class R>
struct Ints
{
    R v;

    Ints() = default;
    CAROM_INLINE Ints(R r) : v(r) {}

    friend CAROM_INLINE Ints operator&(Ints a, Ints b) { return lanes::both(a.v, b.v); }
    friend CAROM_INLINE Ints operator|(Ints a, Ints b) { return lanes::either(a.v, b.v); }
    friend CAROM_INLINE Ints operator~(Ints a) { return lanes::inverted(a.v); }
    friend CAROM_INLINE Ints operator==(Ints a, Ints b) { return lanes::are_equal(a.v, b.v); }
    friend CAROM_INLINE Ints operator!=(Ints a, Ints b) { return ~(a == b); }
    friend CAROM_INLINE Ints operator<(Ints a, Ints b) { return lanes::are_less(a.v, b.v); }
    friend CAROM_INLINE Ints operator>=(Ints a, Ints b) { return ~(a < b); }
    CAROM_INLINE Ints& operator&=(Ints b) { return *this = *this & b; }
    CAROM_INLINE Ints& operator|=(Ints b) { return *this = *this | b; }
};

template <class R>
struct Floats
{
    R v;

    Floats() = default;
    CAROM_INLINE Floats(R r) : v(r) {}
    CAROM_INLINE Floats(float all) { lanes::spread(all, v); }

    friend CAROM_INLINE Floats operator+(Floats a, Floats b) { return lanes::add(a.v, b.v); }
    friend CAROM_INLINE Floats operator-(Floats a, Floats b) { return lanes::subtract(a.v, b.v); }
    friend CAROM_INLINE Floats operator*(Floats a, Floats b) { return lanes::multiply(a.v, b.v); }
    friend CAROM_INLINE Floats operator/(Floats a, Floats b) { return lanes::divide(a.v, b.v); }
    friend CAROM_INLINE Floats operator-(Floats a) { return lanes::negated(a.v); }
    friend CAROM_INLINE auto operator<(Floats a, Floats b) { return Ints(lanes::are_less(a.v, b.v)); }
    friend CAROM_INLINE auto operator>(Floats a, Floats b) { return Ints(lanes::are_less(b.v, a.v)); }
    friend CAROM_INLINE auto operator<=(Floats a, Floats b) { return Ints(lanes::are_at_most(a.v, b.v)); }
    friend CAROM_INLINE auto operator>=(Floats a, Floats b) { return Ints(lanes::are_at_most(b.v, a.v)); }
    friend CAROM_INLINE auto operator==(Floats a, Floats b) { return Ints(lanes::are_equal(a.v, b.v)); }
    friend CAROM_INLINE auto operator!=(Floats a, Floats b) { return Ints(lanes::differ(a.v, b.v)); }
    CAROM_INLINE Floats& operator+=(Floats b) { return *this = *this + b; }
    CAROM_INLINE Floats& operator-=(Floats b) { return *this = *this - b; }
    CAROM_INLINE Floats& operator*=(Floats b) { return *this = *this * b; }

    /// The lesser of two; the second where they are equal or one is NaN.
    friend CAROM_INLINE Floats least(Floats a, Floats b) { return lanes::least(a.v, b.v); }
    friend CAROM_INLINE Floats greatest(Floats a, Floats b) { return lanes::greatest(a.v, b.v); }
    friend CAROM_INLINE Floats magnitude(Floats a) { return greatest(a, -a); }
    friend CAROM_INLINE Floats clamp(Floats a, Floats low, Floats high) { return least(greatest(a, low), high); }
    friend CAROM_INLINE Floats root(Floats a) { return lanes::root(a.v); }
    friend CAROM_INLINE auto as_ints(Floats a) { return Ints(lanes::same_bits(a.v)); } ///< flags that were gathered beside floats
};

/// Lanes in which a comparison of doubles holds.
template <class R>
struct Holds
{
    R v;
};
template <class R>
Holds(R) -> Holds<R>;

template <class R>
struct Doubles
{
    R v;

    Doubles() = default;
    CAROM_INLINE Doubles(R r) : v(r) {}
    CAROM_INLINE Doubles(double all) { lanes::spread(all, v); }

    friend CAROM_INLINE Doubles operator+(Doubles a, Doubles b) { return lanes::add(a.v, b.v); }
    friend CAROM_INLINE Doubles operator-(Doubles a, Doubles b) { return lanes::subtract(a.v, b.v); }
    friend CAROM_INLINE Doubles operator*(Doubles a, Doubles b) { return lanes::multiply(a.v, b.v); }
    friend CAROM_INLINE Doubles operator/(Doubles a, Doubles b) { return lanes::divide(a.v, b.v); }
    friend CAROM_INLINE Doubles operator-(Doubles a) { return lanes::negated(a.v); }
    friend CAROM_INLINE auto operator<(Doubles a, Doubles b) { return Holds{lanes::are_less(a.v, b.v)}; }
    friend CAROM_INLINE auto operator>(Doubles a, Doubles b) { return Holds{lanes::are_less(b.v, a.v)}; }
    friend CAROM_INLINE auto operator<=(Doubles a, Doubles b) { return Holds{lanes::are_at_most(a.v, b.v)}; }
    friend CAROM_INLINE auto operator==(Doubles a, Doubles b) { return Holds{lanes::are_equal(a.v, b.v)}; }
    CAROM_INLINE Doubles& operator-=(Doubles b) { return *this = *this - b; }

    friend CAROM_INLINE Doubles least(Doubles a, Doubles b) { return lanes::least(a.v, b.v); }
    friend CAROM_INLINE Doubles root(Doubles a) { return lanes::root(a.v); }
    friend CAROM_INLINE auto floats(Doubles a) { return Floats(lanes::to_floats(a.v)); } ///< rounded
};

/// Each lane is a where the mask is set, b where it is clear.
template <class M, class R>
CAROM_INLINE Floats<R> select(Ints<M> mask, Floats<R> a, Floats<R> b)
{
    return lanes::choose(mask.v, a.v, b.v);
}
template <class M, class R>
CAROM_INLINE Doubles<R> select(Holds<M> mask, Doubles<R> a, Doubles<R> b)
{
    return lanes::choose(mask.v, a.v, b.v);
}
template <class R>
CAROM_INLINE auto doubles(Floats<R> a)
{
    return Doubles(lanes::to_doubles(a.v));
}

} // namespace carom::internal
