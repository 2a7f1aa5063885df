#pragma once

/// @file
/// carom-pinball --headless: the machine plays by itself, as fast as it can, and counts.

#include <cstdint>
#include <string>

namespace carom::pinball {

struct HeadlessOptions
{
    std::string table{}; ///< file; empty: the table that comes with the program
    std::string ai = "reflex";
    std::uint64_t seed = 1;
    int balls = 100;       ///< served ones, saved ones included
    int balls_at_once = 1; ///< kept in play
    std::string stats{};   ///< file for the numbers; empty: the standard output
    std::string record{};  ///< file: one game is played and recorded there, instead
    std::string watch{};   ///< file: this recorded game is played again, instead
};

/// Plays and writes the numbers; interrupted, it writes those of the finished balls. The exit code of a program: 0, 1 where
/// the table or the file is bad, 130 where it was interrupted.
int run_headless(const HeadlessOptions& options);

/// The same from a command line, with or without the word --headless.
int headless_command(int argc, char** argv);

} // namespace carom::pinball
