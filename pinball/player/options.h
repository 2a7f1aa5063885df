#pragma once

/// @file
/// The command line of the window.

#include <cstdint>
#include <optional>
#include <string>

namespace carom::pinball {

struct PlayerOptions
{
    std::string table{};                 ///< file; empty: the table that comes with the program
    std::optional<std::uint64_t> seed{}; ///< none: another one each time in a window, 1 without
    int width = 1280;
    int height = 800;
    bool autoplay = false;
    double seconds = 0;       ///< then the program ends; 0: when the user ends it
    std::string watch{};      ///< file of a recorded game to play again
    std::string screenshot{}; ///< PNG file, written at the end
    bool xray = false;
    bool mute = false;
    bool fullscreen = false;
    bool tour = false;      ///< starts with the tour
    std::string pictures{}; ///< folder: writes a picture of each page of the tour, and ends

    [[nodiscard]] std::string table_file() const;
};

struct ParsedOptions
{
    std::optional<PlayerOptions> options{}; ///< empty: end with exit_code
    int exit_code = 0;
};

[[nodiscard]] ParsedOptions parse_options(int argc, const char* const* argv);

/// Whether a game is played as fast as it goes, with nobody watching: --autoplay with SDL_VIDEODRIVER=offscreen.
[[nodiscard]] bool plays_offscreen(const PlayerOptions& options);

} // namespace carom::pinball
