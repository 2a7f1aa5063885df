#pragma once

/// @file
/// Recorded games without a window.

#include <cstdint>
#include <string>

namespace carom::pinball {

/// The reflex player plays one game on the table and it is written to the file. Says what came out; the exit code of a program.
int record_game(const std::string& table_file, std::uint64_t seed, const std::string& file);

/// Plays a recorded game again, as fast as it goes, and says whether it came out the same. 0: to the last bit; 1: not, or no such game.
int watch_game(const std::string& file);

} // namespace carom::pinball
