#pragma once

#include <cstddef>
#include <cstdint>

namespace carom::internal {

/// A number that is known not to be negative, as standard containers want it.
[[nodiscard]] constexpr std::size_t as_index(std::int32_t i) { return static_cast<std::size_t>(i); }

} // namespace carom::internal
