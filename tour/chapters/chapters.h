#pragma once

/// @file
/// The chapters. Each is whole in its own file.

#include "tour/chapter.h"

#include <memory>

namespace carom::tour {

[[nodiscard]] std::unique_ptr<Chapter> one_step();
[[nodiscard]] std::unique_ptr<Chapter> who_can_touch_whom();
[[nodiscard]] std::unique_ptr<Chapter> five_pairs();
[[nodiscard]] std::unique_ptr<Chapter> the_blow();
[[nodiscard]] std::unique_ptr<Chapter> sinking_in();
[[nodiscard]] std::unique_ptr<Chapter> triggers();
[[nodiscard]] std::unique_ptr<Chapter> springs();
[[nodiscard]] std::unique_ptr<Chapter> too_many_pairs();
[[nodiscard]] std::unique_ptr<Chapter> changing_the_world();
[[nodiscard]] std::unique_ptr<Chapter> too_fast();
[[nodiscard]] std::unique_ptr<Chapter> many_at_once();

} // namespace carom::tour
