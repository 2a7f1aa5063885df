#pragma once

/// @file
/// The machine plays by itself, off the screen and as fast as it can, and is photographed.

#include "pinball/player/options.h"

namespace carom::pinball {

/// Plays options.seconds of game, prints score, balls and step times, and writes the screenshot. The exit code.
int run_autoplay(const PlayerOptions& options);

} // namespace carom::pinball
