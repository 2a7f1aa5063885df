#pragma once

namespace carom::internal {

/// Exact. Written out, because conversions by themselves are warned of.
[[nodiscard]] constexpr double as_double(float x) { return static_cast<double>(x); }

[[nodiscard]] constexpr double square(double x) { return x * x; }

} // namespace carom::internal
