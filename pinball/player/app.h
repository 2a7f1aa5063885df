#pragma once

/// @file
/// The machine in a window, in real time.

#include "pinball/player/options.h"

namespace carom::pinball {

/// Until the user ends it, or the time of the options is over. The exit code of the program.
int run_app(const PlayerOptions& options);

} // namespace carom::pinball
