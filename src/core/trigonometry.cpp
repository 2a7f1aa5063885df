// sin, cos, atan2 and exp that give the same bits on every platform, and the parts of carom/math.h that need them.

#include "core/trigonometry.h"

#include "carom/math.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace carom {
namespace internal {

namespace {

// pi/2 in two pieces (Cody and Waite): the first has 33 bits, so that n * high is exact for |n| < 2^20.
constexpr double half_pi_high = 1.57079632673412561417;
constexpr double half_pi_low = 6.07710050650619224932e-11;

// Taylor polynomials: on |x| <= pi/4, the omitted terms are below 1e-17.
double sin_polynomial(double x)
{
    const double z = x * x;
    const double p =
        1.0 + z * (-1.0 / 6 +
                   z * (1.0 / 120 +
                        z * (-1.0 / 5040 + z * (1.0 / 362880 + z * (-1.0 / 39916800 +
                                                                    z * (1.0 / 6227020800.0 + z * (-1.0 / 1307674368000.0)))))));
    return x * p;
}

double cos_polynomial(double x)
{
    const double z = x * x;
    return 1.0 + z * (-0.5 + z * (1.0 / 24 +
                                  z * (-1.0 / 720 +
                                       z * (1.0 / 40320 +
                                            z * (-1.0 / 3628800 + z * (1.0 / 479001600 + z * (-1.0 / 87178291200.0 +
                                                                                              z * (1.0 / 20922789888000.0))))))));
}

// At most two halvings of the angle, atan(x) = 2 atan(x / (1 + sqrt(1 + x²))), bring |x| <= 1 below tan(pi/16).
double atan_unit(double x)
{
    double whole = 1;
    for (; x > tan_of_sixteenth; whole *= 2)
        x = x / (1.0 + std::sqrt(1.0 + x * x));
    return whole * atan_small(x);
}

} // namespace

SinCos sin_cos(double radians)
{
    // Clamped before the conversion to integer, NaN as well. Beyond the clamp the angle has lost its meaning, but the result stays defined. For NaN it is
    // NaN.
    double turns = radians * (1.0 / half_pi);
    turns = turns < 1e15 ? (turns > -1e15 ? turns : -1e15) : 1e15;
    const auto n = static_cast<std::int64_t>(turns + (turns >= 0 ? 0.5 : -0.5));
    const auto count = static_cast<double>(n);
    double x = (radians - count * half_pi_high) - count * half_pi_low;
    x = x > 1 ? 1 : (x < -1 ? -1 : x);
    const double s = sin_polynomial(x);
    const double c = cos_polynomial(x);
    switch (static_cast<std::uint64_t>(n) & 3u)
    {
    case 0: return {s, c};
    case 1: return {c, -s};
    case 2: return {-s, -c};
    default: return {-c, s};
    }
}

double arc_tangent(double y, double x)
{
    const double ax = x < 0 ? -x : x;
    const double ay = y < 0 ? -y : y;
    if (ax == 0 && ay == 0)
        return 0;
    const double angle = ay <= ax ? atan_unit(ay / ax) : half_pi - atan_unit(ax / ay);
    const double upper = x < 0 ? 2 * half_pi - angle : angle;
    return y < 0 ? -upper : upper;
}

double exponential(double x)
{
    if (!(x > -700))
        return 0;
    if (x > 700)
        x = 700;
    // ln 2 in two pieces: the first ends in zeros, so that n times it is exact.
    constexpr double ln2_high = 6.93147180369123816490e-01;
    constexpr double ln2_low = 1.90821492927058770002e-10;
    const double turns = x / (ln2_high + ln2_low);
    const auto n = static_cast<std::int64_t>(turns + (turns >= 0 ? 0.5 : -0.5));
    const double r = (x - static_cast<double>(n) * ln2_high) - static_cast<double>(n) * ln2_low;
    double sum = 1;
    for (int k = 14; k >= 1; --k)
        sum = 1 + sum * (r * (1.0 / k));
    return sum * std::bit_cast<double>(static_cast<std::uint64_t>(1023 + n) << 52);
}

} // namespace internal

Vec2 normalize(Vec2 a)
{
    // Scaled first, so that neither tiny nor huge vectors lose their direction.
    const float m = std::fabs(a.x) > std::fabs(a.y) ? std::fabs(a.x) : std::fabs(a.y);
    if (!(m > 0))
        return {};
    const Vec2 b = {a.x / m, a.y / m};
    const float l = length(b);
    return {b.x / l, b.y / l};
}

Rotation Rotation::from_angle(float radians)
{
    if (std::fabs(radians) < 0.25f)
    { // the rotation of a body in a sub-step: these terms are exact to a thousandth of a float's rounding
        const auto x = static_cast<double>(radians);
        const double z = x * x;
        const double s = x * (1 + z * (-1.0 / 6 + z * (1.0 / 120 + z * (-1.0 / 5040))));
        const double c = 1 + z * (-0.5 + z * (1.0 / 24 + z * (-1.0 / 720 + z * (1.0 / 40320))));
        return {static_cast<float>(c), static_cast<float>(s)};
    }
    const internal::SinCos sc = internal::sin_cos(radians);
    return {static_cast<float>(sc.cos), static_cast<float>(sc.sin)};
}

float Rotation::angle() const { return static_cast<float>(internal::arc_tangent(s, c)); }

} // namespace carom
