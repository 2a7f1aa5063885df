#pragma once

#include <string>

namespace carom::pinball {

/// A number as people write it: 0.0135, not 0.013500.
[[nodiscard]] std::string short_number(double value);
/// A distance in millimetres, for sentences.
[[nodiscard]] std::string millimetres(double metres);

} // namespace carom::pinball
