#pragma once

// sin, cos, atan2 and exp from + - * / alone, so that every platform gives the same bits. Errors below 1e-15 relative to 1
// in double for arguments up to 1e6.

namespace carom::internal {

struct SinCos
{
    double sin;
    double cos;
};

[[nodiscard]] SinCos sin_cos(double radians);
[[nodiscard]] double arc_tangent(double y, double x); ///< -pi to pi
[[nodiscard]] double exponential(double x);

} // namespace carom::internal
