#pragma once

// sin, cos, atan2 and exp computed with + - * / and square roots alone, so that every platform gives the same bits. Errors are below 1e-15 relative to 1
// in double for arguments up to 1e6.

#include "core/compiler.h"

namespace carom::internal {

inline constexpr double half_pi = 1.57079632679489661923;
inline constexpr double tan_of_sixteenth = 0.19891236737965801; ///< tan(pi / 16)

/// atan on |x| <= tan(pi/16), for one double or a vector of them: an alternating series whose omitted terms are below 1e-17.
template <class D>
CAROM_INLINE D atan_small(D x)
{
    const D z = x * x;
    D sum{};
    for (int k = 23; k >= 1; k -= 2)
    {
        const double term = 1.0 / k;
        sum = (k % 4 == 1 ? term : -term) + z * sum;
    }
    return x * sum;
}

struct SinCos
{
    double sin;
    double cos;
};

[[nodiscard]] SinCos sin_cos(double radians);
[[nodiscard]] double arc_tangent(double y, double x); ///< -pi to pi
[[nodiscard]] double exponential(double x);

} // namespace carom::internal
