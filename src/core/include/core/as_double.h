#pragma once

// Helpers for calculations in doubles.

namespace carom::internal {

/// Exact. Written out, because implicit conversions give warnings.
[[nodiscard]] constexpr double as_double(float x) { return static_cast<double>(x); }

[[nodiscard]] constexpr double square(double x) { return x * x; }

} // namespace carom::internal
