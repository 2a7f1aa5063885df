#pragma once

// Conversion of signed indices for standard containers.

#include <cstddef>
#include <cstdint>

namespace carom::internal {

/// Converts an index that is known not to be negative to the type that standard containers take.
[[nodiscard]] constexpr std::size_t as_index(std::int32_t i) { return static_cast<std::size_t>(i); }

} // namespace carom::internal
