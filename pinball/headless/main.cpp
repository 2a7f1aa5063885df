// The machine without a window: headless runs and the table checker.

#include "pinball/headless/headless.h"
#include "pinball/headless/new_command.h"
#include "pinball/table/check_command.h"

#include <exception>
#include <iostream>
#include <string_view>

int main(int argc, char** argv)
try
{
    const std::string_view first = argc > 1 ? argv[1] : "";
    if (first == "new")
        return carom::pinball::new_command(argc, argv);
    if (first == "check" && argc == 3)
        return carom::pinball::check_command(argv[2], std::cout);
    return carom::pinball::headless_command(argc, argv);
}
catch (const std::exception& error)
{
    std::cerr << "carom-pinball: " << error.what() << '\n';
    return 1;
}
