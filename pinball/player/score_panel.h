#pragma once

/// @file
/// The score display and what stands around it.

#include "pinball/player/layout.h"
#include "pinball/player/machine.h"
#include "view/canvas.h"

#include <string>

namespace carom::pinball {

/// The state of the program itself.
struct Status
{
    double time = 0; ///< s since the program began
    bool paused = false;
    double speed = 1;
    bool muted = false;
    float volume = 0;
    std::string why_mute{}; ///< not empty: there is no sound card
    std::string trouble{};  ///< why something that was asked for could not be done
};

/// 1234567 as 1,234,567.
[[nodiscard]] std::string with_commas(std::int64_t value);

void draw_score(view::Canvas& screen, const Layout& layout, const Machine& machine, const Status& status);

} // namespace carom::pinball
