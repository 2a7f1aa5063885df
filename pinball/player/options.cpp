#include "pinball/player/options.h"

#include <CLI/CLI.hpp>

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace carom::pinball {

namespace {

bool read_number(std::string_view text, int& value)
{
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
}

bool read_size(const std::string& text, PlayerOptions& options)
{
    const std::size_t x = text.find('x');
    if (x == std::string::npos)
        return false;
    const std::string_view all = text;
    const bool read = read_number(all.substr(0, x), options.width) && read_number(all.substr(x + 1), options.height);
    return read && options.width >= 200 && options.height >= 300 && options.width <= 16384 && options.height <= 16384;
}

} // namespace

std::string PlayerOptions::table_file() const { return table.empty() ? CAROM_TABLES_DIR "/momentum.table.json" : table; }

ParsedOptions parse_options(int argc, const char* const* argv)
{
    CLI::App app{"Carom's pinball machine. `carom-pinball check FILE` looks over a table file, `carom-pinball --headless` plays\n"
                 "without a window (see --headless --help)."};
    PlayerOptions options;
    app.add_option("--table", options.table, "table file")->check(CLI::ExistingFile);
    app.add_option("--seed", options.seed, "of the game and of the player of --autoplay");
    const auto size = [&](const std::string& text) { return read_size(text, options) ? "" : "WIDTHxHEIGHT, from 200x300"; };
    std::string size_text;
    app.add_option("--size", size_text, "WIDTHxHEIGHT of the window")->check(size);
    app.add_flag("--autoplay", options.autoplay, "the machine plays by itself");
    app.add_option("--seconds", options.seconds, "end after this time")->check(CLI::PositiveNumber);
    app.add_option("--screenshot", options.screenshot, "write this PNG file at the end");
    app.add_option("--watch", options.watch, "watch this recorded game")->check(CLI::ExistingFile);
    app.add_flag("--xray", options.xray, "start under the x-ray");
    app.add_flag("--mute", options.mute, "start without sound");
    auto* tour = app.add_flag("--tour", options.tour, "start with the tour: how a 2D engine works, in eleven chapters");
    app.add_option("--screenshots", options.pictures, "with --tour: write a picture of each page into this folder, and end")
        ->needs(tour);
    app.add_flag("--fullscreen", options.fullscreen, "start in full screen");
    try
    {
        app.parse(argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
        return {.options = {}, .exit_code = app.exit(error)};
    }
    return {.options = options};
}

bool plays_offscreen(const PlayerOptions& options)
{
    const char* driver = std::getenv("SDL_VIDEODRIVER");
    return options.autoplay && options.seconds > 0 && driver != nullptr && std::string_view(driver) == "offscreen";
}

} // namespace carom::pinball
