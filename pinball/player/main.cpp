// carom-pinball: the machine in a window; `--headless ...` runs it without one, `check FILE` looks over a table file.

#include "pinball/headless/headless.h"
#include "pinball/headless/new_command.h"
#include "pinball/player/app.h"
#include "pinball/player/autoplay_run.h"
#include "pinball/player/options.h"
#include "pinball/table/check_command.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <string_view>

namespace {

int play(int argc, char** argv)
{
    const carom::pinball::ParsedOptions parsed = carom::pinball::parse_options(argc, argv);
    if (!parsed.options)
        return parsed.exit_code;
    if (carom::pinball::plays_offscreen(*parsed.options))
        return carom::pinball::run_autoplay(*parsed.options);
    return carom::pinball::run_app(*parsed.options);
}

} // namespace

int main(int argc, char** argv)
try
{
    const std::string_view first = argc > 1 ? argv[1] : "";
    if (first == "new")
        return carom::pinball::new_command(argc, argv);
    if (first == "check" && argc == 3)
        return carom::pinball::check_command(argv[2], std::cout);
    if (std::any_of(argv + 1, argv + argc, [](std::string_view word) { return word == "--headless"; }))
        return carom::pinball::headless_command(argc, argv);
    return play(argc, argv);
}
catch (const std::exception& error)
{
    std::cerr << "carom-pinball: " << error.what() << '\n';
    return 1;
}
