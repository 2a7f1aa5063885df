#pragma once

/// @file
/// The pages of the display while nobody plays: the best scores, the prizes, how to start.

#include "pinball/player/machine.h"

#include <string>
#include <vector>

namespace carom::pinball {

struct DisplayPage
{
    std::string large{};
    std::string small{};
};

[[nodiscard]] std::vector<DisplayPage> attract_pages(const Machine& machine);
/// The one that shows at a time, s.
[[nodiscard]] DisplayPage attract_page(const Machine& machine, double time);

} // namespace carom::pinball
