#include "pinball/headless/new_command.h"

#include "pinball/table/new_table.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <system_error>
#include <vector>

namespace carom::pinball {

namespace {

std::string list_of_templates()
{
    std::string text = "Templates:\n";
    for (const Template& one : templates())
        text += "  " + one.name + ": " + one.about + '\n';
    return text;
}

int write(const std::string& file, const std::string& text)
{
    // A table is work: what is there stays.
    std::error_code error;
    if (std::filesystem::exists(file, error))
    {
        std::cerr << file << " is there already; give another name\n";
        return 1;
    }
    std::ofstream out(file);
    out << text;
    out.close();
    if (!out)
    {
        std::cerr << file << ": cannot be written\n";
        return 1;
    }
    std::cout << "wrote " << file << "; play it with --table " << file << ", and press G for a grid\n";
    return 0;
}

} // namespace

int new_command(int argc, char** argv)
try
{
    CLI::App app{"Writes a playable table to begin with."};
    std::string file;
    std::string name = "My table";
    std::vector<std::string> with;
    app.add_option("FILE", file, "something.table.json")->required();
    app.add_option("--name", name, "of the table");
    app.add_option("--with", with, "a template to put in; several may be given")->delimiter(',');
    app.footer(list_of_templates());
    CLI11_PARSE(app, argc - 1, argv + 1);
    return write(file, new_table(name, with));
}
catch (const std::exception& error)
{
    std::cerr << "carom-pinball new: " << error.what() << "; --help lists the templates\n";
    return 1;
}

} // namespace carom::pinball
